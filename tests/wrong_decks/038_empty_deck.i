$ nothing yet
