//! What contact says of a node in a step, and how it travels between ranks.

/// What contact does to a node in a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NodeResult {
    /// Sum of the normal forces on the node, a force.
    pub normal_force: [f64; 3],
    /// Sum of the friction forces on the node, a force.
    pub tangential_force: [f64; 3],
    /// What tells more of it, for output.
    pub details: Details,
}

/// What contact tells of a node beside the forces on it; only output asks for it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Details {
    /// Overlap that the node's own constraints close in the step: a length, at most 0.
    pub gap: f64,
    /// Whether contact forces act on it, and whose.
    pub status: Status,
    /// Number of the face that the node itself touches; 0 where the status says that there is none.
    pub face: u32,
    /// Force of rigid planes, part of the forces above.
    pub plane_force: [f64; 3],
}

/// What acts on a node.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Status {
    /// Nothing.
    #[default]
    Free,
    /// Contact forces: those of a plane, of an edge, or of a node that touches a face of which this one is a corner.
    Loaded,
    /// Contact forces, that of a face which the node itself touches among them.
    OnFace,
}

impl Status {
    /// The number in output and in messages.
    pub fn code(self) -> f64 {
        match self {
            Status::Free => 0.0,
            Status::Loaded => 1.0,
            Status::OnFace => 2.0,
        }
    }

    fn from_code(code: f64) -> Status {
        [Status::Loaded, Status::OnFace].into_iter().find(|status| status.code() == code).unwrap_or_default()
    }
}

/// Numbers of the forces in a message.
pub const FORCES: usize = 6;

/// Numbers of [`Details`] in a message.
pub const DETAILS: usize = 6;

impl NodeResult {
    /// Of a node without contact forces.
    pub const FREE: NodeResult =
        NodeResult { normal_force: [0.0; 3], tangential_force: [0.0; 3], details: Details::NONE };

    /// The forces as numbers.
    pub fn pack_forces(&self) -> [f64; FORCES] {
        let ([a, b, c], [d, e, f]) = (self.normal_force, self.tangential_force);
        [a, b, c, d, e, f]
    }

    /// From the forces as numbers; details come later, if anybody wants them.
    pub fn unpack_forces([a, b, c, d, e, f]: [f64; FORCES]) -> NodeResult {
        NodeResult { normal_force: [a, b, c], tangential_force: [d, e, f], ..NodeResult::FREE }
    }
}

impl Details {
    const NONE: Details = Details { gap: 0.0, status: Status::Free, face: 0, plane_force: [0.0; 3] };

    /// As numbers.
    pub fn pack(&self) -> [f64; DETAILS] {
        let Details { gap, status, face, plane_force: [x, y, z] } = *self;
        [gap, status.code(), f64::from(face), x, y, z]
    }

    /// From these numbers.
    pub fn unpack([gap, status, face, x, y, z]: [f64; DETAILS]) -> Details {
        Details { gap, status: Status::from_code(status), face: face as u32, plane_force: [x, y, z] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_packed_comes_out_again() {
        let details = Details { gap: -0.5, status: Status::OnFace, face: 17, plane_force: [7.0, 8.0, -9.0] };
        let result = NodeResult { normal_force: [1.0, -0.0, 3.0], tangential_force: [4.0, 5.0, 6.0], details };
        let forces = NodeResult::unpack_forces(result.pack_forces());
        assert_eq!(NodeResult { details, ..forces }, result);
        for status in [Status::Free, Status::Loaded, Status::OnFace] {
            let details = Details { status, ..details };
            assert_eq!(Details::unpack(details.pack()), details);
        }
    }
}
