//! What erosion carries from step to step.

use super::Erosion;
use crate::lanes::{CHUNK, Row};
use crate::restart::Archive;
use crate::solver::domain::ABSENT;
use crate::solver::elements::ElementBlock;

impl Erosion {
    /// Visits which elements are gone and their energy, and takes them away when loading; returns the canonical numbers of
    /// those that are gone on any rank, ascending, when loading. `file` and `canonical` tell of each local element its
    /// place in the mesh file and its number in the whole body.
    pub fn visit_state(
        &mut self,
        archive: &mut dyn Archive,
        blocks: &mut [ElementBlock],
        file: &[u32],
        canonical: &[u32],
    ) -> Vec<u32> {
        let Erosion {
            energy,
            gone,
            taken: _,
            element_order,
            deletions,
            keeps,
            element_unknowns,
            // Of the problem, or counted anew by `take_away`.
            rules: _,
            step_scale: _,
            local: _,
            left: _,
            places: _,
            stand_in: _,
            edge: _,
        } = self;
        archive.heap("DEADE", energy);
        visit_steps(archive, blocks, file);
        let mut deleted: Vec<f64> = Vec::new();
        if archive.comm().rank() == 0 {
            deleted.extend(deletions.gone.iter().map(|&block| block as f64));
        }
        archive.list("DELETED", 1, &mut deleted);
        if archive.loading() {
            deletions.gone = deleted.iter().map(|&block| block as i64).collect();
            deletions.to_come.retain(|one| deletions.gone.binary_search(&one.block).is_err());
            *keeps = deletions.keeps(element_unknowns, keeps.len());
        }
        let groups = blocks.iter().flat_map(|block| block.groups());
        let mut dead: Vec<f64> = groups
            .flat_map(|group| (0..group.len()).filter(|&i| !group.is_alive(i)).map(|i| group.places[i]))
            .map(|place| f64::from(file[place as usize]))
            .collect();
        archive.list("DEAD", 1, &mut dead);
        if !archive.loading() {
            return Vec::new();
        }
        *gone = dead.len() as u64;
        let is_dead = |file: &u32| dead.binary_search_by(|d| d.total_cmp(&f64::from(*file))).is_ok();
        let dead: Vec<u32> =
            (0u32..).zip(element_order.iter()).filter(|(_, file)| is_dead(file)).map(|(number, _)| number).collect();
        self.take_away(&dead, blocks, canonical);
        dead
    }

    /// Takes elements away that went before, with energies and nodes that are known.
    fn take_away(&mut self, dead: &[u32], blocks: &mut [ElementBlock], canonical: &[u32]) {
        for block in blocks {
            let stand_in = self.stand_in(block);
            for group in [&mut block.border, &mut block.interior] {
                for i in 0..group.len() {
                    if dead.binary_search(&canonical[group.places[i] as usize]).is_ok() {
                        stand_in.take_over(group, i);
                    }
                }
            }
        }
        for &element in dead {
            for &node in &self.element_unknowns[element as usize] {
                let here = self.local[node as usize];
                if here != ABSENT {
                    self.left[here as usize] -= 1;
                }
            }
        }
    }
}

/// Visits the stable steps of elements whose steps are watched, by their places in the mesh file.
fn visit_steps(archive: &mut dyn Archive, blocks: &mut [ElementBlock], file: &[u32]) {
    let mut rows: Vec<f64> = Vec::new();
    for group in blocks.iter().flat_map(|block| block.groups()) {
        let known = (0..group.len()).filter_map(|i| Some((group.places[i], group.stable_step(i)?)));
        rows.extend(known.flat_map(|(place, step)| [f64::from(file[place as usize]), step]));
    }
    archive.list("STEPS", 2, &mut rows);
    if !archive.loading() || rows.is_empty() {
        return;
    }
    let (rows, _) = rows.as_chunks::<2>();
    for block in blocks.iter_mut().filter(|block| block.keeps_steps) {
        for group in [&mut block.border, &mut block.interior] {
            group.steps = vec![Row::default(); group.mass.len()];
            for (i, &place) in group.places.iter().enumerate() {
                let found = rows.binary_search_by(|row| row[0].total_cmp(&f64::from(file[place as usize])));
                // What the state does not know has not failed.
                group.steps[i / CHUNK].0[i % CHUNK] = found.map_or(f64::INFINITY, |row| rows[row][1]);
            }
        }
    }
}
