//! What the solver carries from one step to the next: visited to write a restart, and in the same way to go on from one.
//!
//! The state is that between two steps, after [`Solver::advance`] and before [`Solver::prepare`]: no forces exist then.
//! Every struct is taken apart field by field, without a rest, so that a new field does not compile until somebody has
//! said whether it belongs to the state (visited), to the problem, or to the step (`_`).

mod elements;
pub(super) mod remembered;
mod works;

use super::loads::{self, LOADS, Places};
use super::nodes::Nodes;
use super::{Domain, Solver};
use crate::comm::Communicator;
use crate::lanes::Row;
use crate::restart::{Archive, Loader, Snapshot, TIME};

impl Solver {
    /// Visits the state between two steps. All ranks call it.
    pub fn visit_state(&mut self, archive: &mut dyn Archive) {
        let Solver {
            domain,
            step,
            time,
            previous_time,
            time_step,
            kick,
            initial_energy,
            first_stable_step,
            watch,
            global_step,
            last_totals,
            remembered,
            // Nothing is written once the end has made steps shorter.
            whole_step,
            // Of the step: found anew by `prepare`.
            stable_step: _,
            own_step: _,
            local: _,
            pass: _,
            // Of the problem.
            clock: _,
            control: _,
            // Of the first state.
            slivers: _,
            end: _,
            ending: _,
            functions: _,
            prescribed: _,
        } = self;
        archive.count("NSTEPS", step);
        archive.number(TIME, time);
        archive.number("LASTTIME", previous_time);
        archive.number("TMSTEP", time_step);
        if archive.loading() {
            *whole_step = *time_step;
        }
        archive.number("KICK", kick);
        archive.number("INITIALE", initial_energy);
        let mut first = first_stable_step.unwrap_or(f64::INFINITY);
        archive.number("FIRSTSTEP", &mut first);
        *first_stable_step = first.is_finite().then_some(first);
        if archive.loading() {
            *last_totals = None;
        }
        remembered.visit_state(archive);
        domain.visit_state(archive);
        global_step.iter_mut().for_each(|global| global.visit_state(archive, domain));
        watch.visit_state(archive);
    }

    /// Goes on from a state, of this problem but of any number of ranks. All ranks call it.
    ///
    /// # Errors
    /// The names of what the state should hold and does not.
    pub fn restore(&mut self, snapshot: &Snapshot, comm: &mut dyn Communicator) -> Result<(), Vec<String>> {
        let mut loader = Loader::new(snapshot, &self.domain.nodes.file, &self.domain.element_file, comm);
        self.visit_state(&mut loader);
        let missing = loader.missing();
        if missing.is_empty() { Ok(()) } else { Err(missing) }
    }
}

impl Domain {
    fn visit_state(&mut self, archive: &mut dyn Archive) {
        let Domain {
            nodes,
            blocks,
            element_file,
            element_canonical,
            element_rows,
            point_rows,
            law_states,
            pressure_faces,
            loads,
            constraints,
            axis,
            carried_work,
            contact,
            erosion,
            rigid,
            // Of the problem and its cut.
            ties: _,
            element_id: _,
            rotations: _,
            layered: _,
            added_mass: _,
            mass_added: _,
            exchange: _,
        } = self;
        rigid.iter_mut().for_each(|rigid| rigid.visit_state(archive, nodes));
        nodes.visit_state(archive);
        let mut dead = Vec::new();
        if let Some(erosion) = erosion {
            dead = erosion.visit_state(archive, blocks, element_file, element_canonical);
        }
        elements::visit(archive, blocks, [element_rows, law_states], point_rows, element_file.len());
        archive.heap("CARRIEDW", carried_work);
        let places = Places { nodes, elements: [element_file, element_canonical] };
        carried_work.extend(works::of_constraints(archive, constraints, &places));
        // What it has done to nodes that are held since is external work from then on.
        if let Some(axis) = axis {
            carried_work.extend(works::of_axis(archive, axis, &places));
        }
        for entry in LOADS {
            let mut all = loads::all(pressure_faces, loads);
            let found = all.find(|load| load.entry().works == entry.works);
            carried_work.extend(match found {
                Some(load) => works::of_load(archive, load, &places),
                None => works::of_none(archive, entry.works, entry.key, &places),
            });
        }
        if archive.loading() {
            loads::all(pressure_faces, loads).for_each(|load| load.lose(&dead, true));
        }
        if let Some(contact) = contact {
            contact.visit_state(archive, &dead, erosion.as_ref(), nodes);
        }
    }
}

impl Nodes {
    fn visit_state(&mut self, archive: &mut dyn Archive) {
        // Forces are zero between steps; the others are of the problem and its cut.
        let Nodes { rows, forces: _, mesh: _, beside: _, places, file, owned, rates, passive: _ } = self;
        const NAMES: [&str; 8] = ["POSX", "POSY", "POSZ", "NODMASS", "VELX", "VELY", "VELZ", "INVMASS"];
        for (i, name) in NAMES.into_iter().enumerate() {
            let mut values: Vec<f64> = rows[..*places].iter().map(|row| row.0[i]).collect();
            archive.nodal(name, &mut values);
            rows.iter_mut().zip(values).for_each(|(row, value)| row.0[i] = value);
        }
        if rates.are_wanted() {
            archive.nodal("NODRATE", &mut rates.means);
        }
        visit_rotations(archive, &mut rows[*places..], &file[*places..], &owned[*places..]);
    }
}

/// Visits the rows of rotations by their numbers. They are a list of their own, which is empty where nothing turns.
fn visit_rotations(archive: &mut dyn Archive, rows: &mut [Row], numbers: &[u32], owned: &[bool]) {
    let own = rows.iter().zip(numbers).zip(owned).filter(|(_, owned)| **owned);
    let mut list: Vec<f64> =
        own.flat_map(|((row, &number), _)| std::iter::once(f64::from(number)).chain(row.0)).collect();
    archive.list("ROTATION", 9, &mut list);
    if !archive.loading() {
        return;
    }
    let (list, _) = list.as_chunks::<9>();
    for (row, &number) in rows.iter_mut().zip(numbers) {
        if let Ok(found) = list.binary_search_by(|one| one[0].total_cmp(&f64::from(number))) {
            row.0.copy_from_slice(&list[found][1..]);
        }
    }
}
