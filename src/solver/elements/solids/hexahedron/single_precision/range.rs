//! Which elements single precision can hold: products in the kernel must neither vanish nor grow beyond all measure.

use crate::material::Moduli;
use crate::mesh::Block;
use crate::mesh::check::hexahedron_volume;
use crate::solver::elements::Unfit;

/// Numbers of single precision, with some room for factors and small strains.
const LEAST: f64 = 1e-34;
const MOST: f64 = 1e33;

/// Moduli whose stresses can be squared, down to strains of 10⁻⁹.
const MODULI: [f64; 2] = [1e-8, 1e16];

/// Why a block of hexahedra with this density (mass/length³) and these moduli cannot be computed in single precision, if it
/// cannot. The largest products are B_iI B_iI ~ h⁴ and M V ~ ρ h⁶ of an edge h.
pub fn beyond(block: &Block, coordinates: &[[f64; 3]], (density, moduli): (f64, Moduli)) -> Option<Unfit> {
    let mut edges = [f64::INFINITY, 0.0f64];
    for nodes in block.hexahedra() {
        let corners = nodes.map(|node| coordinates.get(node as usize).copied().unwrap_or_default());
        let edge = hexahedron_volume(&corners).abs().cbrt();
        edges = [edges[0].min(edge), edges[1].max(edge)];
    }
    let held = |edge: f64| {
        let products = [edge.powi(4), density * edge.powi(6), density * edge.powi(3)];
        products.iter().all(|product| (LEAST..MOST).contains(product))
    };
    let modulus = moduli.dilatational();
    let what = if let Some(edge) = edges.into_iter().find(|&edge| edge > 0.0 && edge.is_finite() && !held(edge)) {
        format!("elements {edge:.1e} in length at a density of {density:.1e}")
    } else if modulus > 0.0 && !(MODULI[0]..MODULI[1]).contains(&modulus) {
        format!("a modulus of {modulus:.1e}")
    } else {
        return None;
    };
    let reason = format!("PRECISION, SINGLE cannot hold {what}: its numbers end at 1E-38 and 3E38");
    Some(Unfit { reason, help: "choose units in which these are nearer to 1, or PRECISION, DOUBLE".into() })
}
