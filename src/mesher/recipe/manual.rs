//! The manual page urto-mesh(5), made from the tables that recipes are read by.

use super::language;
use crate::deck;

/// What stands before the commands.
const RULES: &str = r#".TH URTO-MESH 5 "" "urto" "File formats"
.SH NAME
urto-mesh \- mesh recipes of urto
.SH DESCRIPTION
A recipe is a text file that describes a mesh of simple bodies in commands.
.B urto mesh
makes a GENESIS file from it, and
.B urto run
makes the mesh of a deck that has no BASE.g but a BASE.mesh.
Lines, fields, numbers, abbreviations and expressions in braces are those of decks, see
.BR urto\-deck (5).
.SS Order of work
Shapes are made and moved in the order of the recipe: a move acts on the shapes above it.
From the finished shapes MERGE joins what belongs together, SPLIT BLOCK divides, PERTURB disturbs, and the sets are picked
last, wherever their commands stand.
Shapes that touch are separate bodies unless they are merged.
.SS Numbers
Every shape belongs to a block. Blocks, node sets and side sets have the numbers that the recipe gives them; the commands of
a deck call them by these.
.SS Refinement
.B urto mesh \-\-refine N
multiplies every number of elements by N. Nothing else changes, so a series of refined meshes is one command.
.SS The same mesh everywhere
A recipe gives the same mesh to the last bit on every machine.
"#;

/// Headings of the families, in the order of the card files.
const HEADINGS: &[(&str, &str)] = &[
    ("recipe", "THE WHOLE RECIPE"),
    ("shapes", "SHAPES"),
    ("moves", "MOVING AND JOINING"),
    ("sets", "NODE SETS AND SIDE SETS"),
];

const CLOSING: &str = r#".SH EXAMPLE
A bar of two blocks that are joined, with sets for its symmetry planes and its loaded end:
.PP
.RS
.nf
TITLE
TWO BARS END TO END
BOX, 1,  0., 0., 0.,  1., 1., 4.,  4, 4, 16
COPY, 1, 2,  0., 0., 4.
MERGE
NODE SET PLANE, 1, X, 0.
NODE SET PLANE, 2, Y, 0.
SIDE SET PLANE, 100, Z, 8.
.fi
.RE
.SH SEE ALSO
.BR urto (1),
.BR urto\-deck (5)
"#;

/// The manual page in roff.
pub fn manual() -> String {
    RULES.to_string() + &deck::chapters(language(), HEADINGS) + CLOSING
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesher;

    #[test]
    fn every_family_has_a_heading() {
        let families: Vec<&str> = HEADINGS.iter().map(|(family, _)| *family).collect();
        assert_eq!(families, mesher::CARDS.iter().map(|(family, _)| *family).collect::<Vec<_>>());
    }

    #[test]
    fn the_example_makes_a_mesh() {
        let recipe = CLOSING.split(".nf\n").nth(1).and_then(|rest| rest.split(".fi").next()).expect("an example");
        let mesh = mesher::make(recipe, "example.mesh", 1).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        assert_eq!((mesh.element_count(), mesh.coordinates.len()), (2 * 256, 25 * 33));
        assert_eq!((mesh.node_sets[0].nodes.len(), mesh.side_sets[0].sides.len()), (5 * 33, 16));
    }
}
