//! What the plot file shows of the elements of rigid blocks, which have no work to do and so no state of their own.

use crate::program::Desk;

/// A rigid brick turns freely about its own axis by a right angle: at the end every element has turned by it, on any number of ranks.
#[test]
fn elements_of_a_rigid_block_have_turned_as_it_has() {
    let desk = Desk::new();
    desk.put(
        "case.i",
        "TITLE\n a quarter of a turn\nTERMINATION TIME, 0.01570796326794897\nTIME STEP MAXIMUM, 1.E-5\nPLOT ELEMENT, ROTATION\n\
         RIGID BODY, 1\nINITIAL VELOCITY ANGULAR, 1, 100., 0., 0., 0., 0., 0., 1.\nMATERIAL, 1, ELASTIC, 7800.\n\
         YOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\nEND\nEXIT\n",
    );
    desk.put("case.mesh", "TITLE\n brick\nBOX, 1, -0.05, -0.1, -0.2, 0.1, 0.2, 0.4, 2, 3, 4\n");
    for ranks in ["1", "2"] {
        desk.urto(&["case.i", "-q", "--ranks", ranks]).with(0);
        let results = desk.results("case.e");
        let last = results.times().len() - 1;
        // A step of a thousandth of a radian turns by a third of its cube too little or too much.
        let expected = [("R11", 0.0), ("R12", -1.0), ("R21", 1.0), ("R22", 0.0), ("R33", 1.0)];
        for (name, expected) in expected {
            let values = results.element(name, last).expect("element values");
            assert_eq!(values.len(), 24);
            assert!(values.iter().all(|value| (value - expected).abs() < 1e-6), "{name}: {values:?}");
        }
    }
}
