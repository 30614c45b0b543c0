//! What the plot file can hold: fields of nodes and of elements, with their words in the deck and their names in the file.

macro_rules! fields {
    ($(#[$m:meta])* $name:ident { $($(#[$doc:meta])* $variant:ident = $keyword:literal, [$($component:literal),+], $meaning:literal;)+ }) => {
        $(#[$m])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub enum $name { $($(#[$doc])* $variant,)+ }
        impl $name {
            /// All fields.
            pub const ALL: &'static [$name] = &[$($name::$variant),+];
            /// The word that the PLOT command knows.
            pub fn keyword(self) -> &'static str { match self { $($name::$variant => $keyword,)+ } }
            /// Names of the EXODUS variables, one per component in space.
            pub fn components(self) -> &'static [&'static str] { match self { $($name::$variant => &[$($component),+],)+ } }
            /// What the field is, for the manual.
            pub fn meaning(self) -> &'static str { match self { $($name::$variant => $meaning,)+ } }
        }
    };
}

fields! {
    /// What PLOT NODAL can ask for.
    NodalField {
        /// u
        Displacement = "DISPLACEMENT", ["DISPLX", "DISPLY", "DISPLZ"], "displacement from the initial position, length";
        /// v
        Velocity = "VELOCITY", ["VELX", "VELY", "VELZ"], "velocity at the time of the state, length/time";
        /// a
        Acceleration = "ACCELERATION", ["ACCLX", "ACCLY", "ACCLZ"], "acceleration, length/time squared";
        /// r
        Reaction = "REACTION", ["RX", "RY", "RZ"], "force that holds or drives a node: constraints, prescribed motion, rigid surfaces";
        /// m
        Mass = "MASS", ["NODMASS"], "lumped nodal mass";
        /// contact
        Contact = "CONTACT", ["CONTX", "CONTY", "CONTZ", "CONTGAP", "CONTSTAT", "CONTFACE"], "contact force, of rigid surfaces too; overlap that is closed in the coming step; 0 free, 1 pushed, 2 pushed as a node on a face; element of that face";
        /// angle
        Rotation = "ROTATION", ["ROTX", "ROTY", "ROTZ"], "integral of the rotation rate of a node of shells or beams, radians";
        /// rotation rate
        RotationRate = "ROTATION RATE", ["ROTVELX", "ROTVELY", "ROTVELZ"], "rotation rate of a node of shells or beams, radians/time";
        /// home
        ContactRank = "CONTACT RANK", ["CONTRANK"], "rank that computes the contact of a node, −1 where there is none";
    }
}

fields! {
    /// What PLOT ELEMENT can ask for.
    ElementField {
        /// Cauchy stress
        Stress = "STRESS", ["SIGXX", "SIGYY", "SIGZZ", "TAUXY", "TAUYZ", "TAUZX"], "Cauchy stress without bulk viscosity, positive in tension, force/length squared; of shells transverse shear is the shear force over the thickness, of beams the normal force over the area and nothing else";
        /// Hencky strain
        Strain = "STRAIN", ["EPSXX", "EPSYY", "EPSZZ", "EPSXY", "EPSYZ", "EPSZX"], "logarithmic strain ln V, tensor shear components";
        /// p
        Pressure = "PRESSURE", ["PRESSURE"], "minus the mean stress, positive in compression; of beams that of the normal force over the area";
        /// von Mises
        VonMises = "VONMISES", ["VONMISES"], "von Mises equivalent stress; of shells that of the mean stress, of beams the largest normal stress of a fibre, which is below that of the surface, without torsion and shear";
        /// energy per volume
        Energy = "ENERGY", ["ENERGY"], "work of the stress since the start per unit initial volume: internal energy without the heat of viscosities";
        /// energy per mass
        SpecificEnergy = "EINT", ["EINT"], "specific internal energy, energy/mass, as an equation of state sees it: INITIAL ENERGY, work of the stress and of bulk viscosity, in fluids of hourglass resistance too";
        /// T
        Temperature = "TEMPERATURE", ["TEMPERATURE"], "temperature, of materials that have one (JOHNSON COOK), else 0";
        /// rho
        Density = "DENSITY", ["DENSITY"], "current mass density";
        /// hourglass energy
        HourglassEnergy = "HOURGLASS", ["HGENERGY"], "hourglass energy per unit initial volume";
        /// V
        Stretch = "STRETCH", ["STRETXX", "STRETYY", "STRETZZ", "STRETXY", "STRETYZ", "STRETZX"], "left stretch V, the stretch seen in space";
        /// R
        Rotation = "ROTATION", ["R11", "R12", "R13", "R21", "R22", "R23", "R31", "R32", "R33"], "rotation R of the element since the start, with F = V R; of trusses the smallest that takes them where they lie";
        /// q
        BulkViscosity = "BULKQ", ["BULKQ"], "pressure of the bulk viscosity in the last step, positive in compression";
        /// corner Jacobian
        Corners = "CORNERS", ["CORNER"], "least Jacobian of the corners over the mean one: 1 in a parallelepiped, 0 or less where a corner is inside out";
        /// thickness
        Thickness = "THICKNESS", ["THICKNESS"], "present thickness of shells, length";
        /// resultants
        Resultants = "RESULTANTS", ["NXX", "NYY", "NXY", "MXX", "MYY", "MXY", "QX", "QY"], "of shells forces and moments per length, in axes that turn with the material; of beams normal force (NXX), moments about y and z of the section (MXX, MYY), torque (MXY), shear forces along y and z (QX, QY)";
        /// alive
        Status = "STATUS", ["STATUS"], "1 for an element, 0 for one that was taken away";
        /// rank
        Rank = "RANK", ["RANK"], "rank that computes the element";
    }
}

impl ElementField {
    /// Whether it differs between the points of integration of an element, and is plotted at some of them.
    pub fn of_points(self) -> bool {
        matches!(self, ElementField::Stress | ElementField::Pressure | ElementField::VonMises)
    }
}
