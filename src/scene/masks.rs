//! What tells the materials of a pass apart: ids or mattes.

use std::collections::BTreeSet;

use super::Angles;
use crate::photo::Plane;

/// What tells the materials of a pass apart.
#[derive(Clone, Debug)]
pub enum Masks {
    /// Nothing: every material is seen at all the angles of the pass.
    None,
    /// A picture of whole numbers, one for each material.
    Ids(Plane),
    /// One picture for each material, by its share of each pixel.
    Mattes(Vec<Plane>),
}

impl Masks {
    pub(super) fn planes(&self) -> Vec<&Plane> {
        match self {
            Self::None => Vec::new(),
            Self::Ids(plane) => vec![plane],
            Self::Mattes(planes) => planes.iter().collect(),
        }
    }

    /// Refuses an id that no pixel of the picture can have.
    pub(super) fn check_ids(&self, ids: &[u32]) -> Result<(), String> {
        let Self::Ids(Plane { name, channel, ids: possible, .. }) = self else { return Ok(()) };
        match ids.iter().find(|id| **id > possible.largest) {
            Some(id) => Err(format!(
                "{name} cannot have the id {id}: the numbers of channel {channel} tell ids apart up to {}",
                possible.largest
            )),
            None => Ok(()),
        }
    }

    /// How the materials are told apart, to follow the sentence about the pass.
    pub(super) fn scene(&self) -> String {
        match self {
            Self::None => String::new(),
            Self::Ids(plane) => format!("; ids of {}, channel {}", plane.name, plane.channel),
            Self::Mattes(planes) => {
                let names: Vec<String> = planes.iter().map(|plane| plane.name.clone()).collect();
                format!("; mattes {}", listed(&names))
            }
        }
    }

    /// Sentences about the ids and mattes that show nothing of the pass.
    pub(super) fn unseen(&self, ids: &[u32], angles: &[Angles]) -> Vec<String> {
        let empty = |index: &usize| angles[*index].is_empty();
        match self {
            Self::None => Vec::new(),
            Self::Ids(plane) => {
                let unseen: Vec<u32> = (0..ids.len()).filter(empty).map(|index| ids[index]).collect();
                if unseen.is_empty() { Vec::new() } else { of_unseen_ids(plane, &unseen) }
            }
            Self::Mattes(planes) => {
                let unseen = (0..planes.len()).filter(empty).map(|index| planes[index].name.as_str());
                unseen.map(|name| format!("{name} covers nothing of the pass: its material is not seen")).collect()
            }
        }
    }
}

/// Sentences about ids that are not seen, with those that are in the picture.
fn of_unseen_ids(plane: &Plane, unseen: &[u32]) -> Vec<String> {
    let found = ids_of(plane);
    let words = |ids: &[u32]| listed(&ids.iter().map(u32::to_string).collect::<Vec<_>>());
    let (hidden, absent): (Vec<u32>, Vec<u32>) = unseen.iter().partition(|id| found.contains(id));
    let there: Vec<u32> = found.into_iter().collect();
    let there = if there.is_empty() { "no whole number".to_owned() } else { words(&there) };
    let told = |ids: Vec<u32>, place: &str| {
        let [id, it] = if ids.len() == 1 { ["id", "its material is"] } else { ["ids", "their materials are"] };
        let verb = if ids.len() == 1 { "is" } else { "are" };
        (!ids.is_empty()).then(|| format!("{}: the {id} {} {verb} {place}: {it} not seen", plane.name, words(&ids)))
    };
    let absent = told(absent, &format!("not in the picture, which has {there}"));
    let hidden = told(hidden, "only where the pass has no surface");
    absent.into_iter().chain(hidden).collect()
}

/// The ids that a picture has.
fn ids_of(plane: &Plane) -> BTreeSet<u32> {
    let (mut found, mut last) = (BTreeSet::new(), None);
    for id in (0..plane.values.len()).map(|pixel| plane.id(pixel)) {
        // Neighbours mostly share it.
        if id != last {
            found.extend(id);
            last = id;
        }
    }
    found
}

/// So many things are named one by one.
const MOST_NAMED: usize = 8;

/// `a, b and c`, or the first ones and how many more.
fn listed(all: &[String]) -> String {
    match all {
        [] => String::new(),
        [one] => one.clone(),
        [most @ .., last] if all.len() <= MOST_NAMED => format!("{} and {last}", most.join(", ")),
        _ => format!("{} and {} more", all[..MOST_NAMED].join(", "), all.len() - MOST_NAMED),
    }
}
