//! The disk of one keypoint: contacts, order, emptiness, position.

use std::cmp::Ordering;
use std::ops::ControlFlow;

use super::direction::Contacts;
use super::enclosure::{Enclosure, common_contact, norm1};
use super::keypoints::{One, Run};
use super::maximal_disk::{MaximalDisk, ulp_of_scale};
use super::{Defect, Name};
use crate::domain::Site;
use crate::geom::Double;

/// How far positions and radii may be from the exact ones, in units in the last place of the
/// largest of |x|, |y| and the radius: what exact engines promise.
const POSITION_ULPS: f64 = 4.0;

/// Relative error that covers a distance computed in doubles.
const ROUNDING: f64 = 1.0 / (1u64 << 46) as f64;

impl One<'_, '_> {
    /// Whether every governor touches the disk, inside its zone, in the order of the list.
    pub(super) fn check_contacts(
        &mut self,
        disk: &MaximalDisk,
        sites: &[Site],
        runs: &[Run],
    ) -> bool {
        let (keypoint, at) = (self.number, self.keypoint.position);
        let list = self.context.axis.governors(keypoint);
        let before = self.defects.len();
        for (&site, &number) in sites.iter().zip(list) {
            if disk.side(site) != Ordering::Equal {
                self.defects.push(Defect::NotTouching { keypoint, site: number, at });
            }
        }
        if self.defects.len() > before {
            return false;
        }
        for run in runs {
            let members = (0..run.len).map(|k| (run.first + k) % sites.len());
            // A corner and its own edge that both touch do so at the corner.
            if members.clone().any(|k| run.len > 1 && !sites[k].is_edge()) {
                continue;
            }
            for k in members {
                if !disk.in_zone(sites[k]) {
                    self.defects.push(Defect::OutsideZone { keypoint, site: list[k], at });
                }
            }
        }
        self.check_order(disk, sites, runs);
        self.defects.len() == before
    }

    /// The contacts follow one another counterclockwise, once around.
    fn check_order(&mut self, disk: &MaximalDisk, sites: &[Site], runs: &[Run]) {
        let three = disk.sites();
        let distinct = (0..3).all(|k| {
            let (a, b) = (three[k], three[(k + 1) % 3]);
            common_contact(self.context.domain, a, b).is_none()
        });
        if runs.len() < 3 || runs.len() == 3 && distinct {
            return;
        }
        let contacts = Contacts::new(self.context.domain, disk);
        let site = |k: usize| sites[runs[k].first];
        let mut half = 0;
        for k in 1..runs.len() {
            let here = contacts.half(site(0), site(k));
            let ahead = match here.cmp(&half) {
                Ordering::Greater => true,
                Ordering::Less => false,
                Ordering::Equal => contacts.turn(site(k - 1), site(k)) == Ordering::Greater,
            };
            if !ahead {
                let list = self.context.axis.governors(self.number);
                self.defects.push(Defect::Order {
                    keypoint: self.number,
                    first: list[runs[k - 1].first],
                    second: list[runs[k].first],
                    at: self.keypoint.position,
                });
                return;
            }
            half = here;
        }
    }

    /// No other site cuts or touches the disk; reports the first that does.
    pub(super) fn check_empty(&mut self, disk: &MaximalDisk, listed_by: &[u32]) {
        let (context, number) = (self.context, self.number);
        let enclosure = disk.enclosure();
        let (centre, radius) = (enclosure.centre(), enclosure.radius.value());
        let margin = enclosure.bound + ROUNDING * (norm1(centre) + radius + context.size);
        let at = self.keypoint.position;
        let listed = |site: Site| listed_by[site.0 as usize] == number + 1;
        let cut =
            |site| Some(Defect::Cut { keypoint: number, by: Name::of(context.domain, site), at });
        let missing = |site| {
            let site = Name::of(context.domain, site);
            Some(Defect::MissingGovernor { keypoint: number, site, at })
        };
        let reach = radius + margin;
        let mut crowd = context.crowd();
        let found = context.tree.near(centre, reach, |edge| {
            if crowd.is_over() {
                return ControlFlow::Break(None);
            }
            let distance = context.distance(centre, edge);
            if distance > reach {
                return ControlFlow::Continue(());
            }
            if distance < radius - margin {
                return ControlFlow::Break(cut(Site::edge(edge)));
            }
            let corner = Site::corner(edge);
            let start = context.domain.edge(edge).start;
            if !listed(corner) && (centre - start).norm() <= reach {
                match disk.side(corner) {
                    Ordering::Less => return ControlFlow::Break(cut(corner)),
                    Ordering::Equal if disk.in_zone(corner) => {
                        return ControlFlow::Break(missing(corner));
                    }
                    // A convex or straight corner is touched only with its edges.
                    _ => {}
                }
            }
            if !listed(Site::edge(edge)) {
                match disk.touch(edge) {
                    Some(Ordering::Less) => return ControlFlow::Break(cut(Site::edge(edge))),
                    Some(Ordering::Equal) => {
                        return ControlFlow::Break(missing(Site::edge(edge)));
                    }
                    _ => {}
                }
            }
            ControlFlow::Continue(())
        });
        self.defects.extend(found.flatten());
    }

    pub(super) fn check_position(&mut self, disk: &Enclosure) {
        let (keypoint, at) = (self.number, disk.centre());
        let position = self.keypoint.position;
        let ulp = ulp_of_scale(at, disk.radius.value());
        let off = |exact: Double, claimed: f64| {
            let off = (exact - claimed.into()).value().abs();
            if off.is_nan() { f64::INFINITY } else { off }
        };
        let limit = POSITION_ULPS * ulp + disk.bound;
        let moved = off(disk.x, position.x).max(off(disk.y, position.y));
        if moved > limit {
            self.defects.push(Defect::Position { keypoint, ulps: moved / ulp, at });
        }
        let grown = off(disk.radius, self.keypoint.radius);
        if grown > limit {
            self.defects.push(Defect::Radius { keypoint, ulps: grown / ulp, at });
        }
    }

    /// The disk of a tip, with any two governors: near enough to both, inside their zones, and
    /// nothing nearer, all in doubles with a margin for what rounding its numbers may do.
    pub(super) fn check_tip(&mut self, sites: &[Site]) {
        let (keypoint, at) = (self.number, self.keypoint.position);
        let radius = self.keypoint.radius;
        let list = self.context.axis.governors(keypoint);
        let margin = 2.0 * POSITION_ULPS * ulp_of_scale(at, radius)
            + ROUNDING * (norm1(at) + radius + self.context.size);
        let sound = at.x.is_finite() && at.y.is_finite() && radius > 0.0;
        if !sound {
            self.defects.push(Defect::NoDisk { keypoint, at });
            return;
        }
        let before = self.defects.len();
        for (&site, &number) in sites.iter().zip(list) {
            let edge = self.context.domain.edge(site.index());
            let distance = if site.is_edge() {
                self.context.distance(at, site.index())
            } else {
                (at - edge.start).norm()
            };
            if (distance - radius).abs() > margin {
                self.defects.push(Defect::NotTouching { keypoint, site: number, at });
            }
            let behind = site.is_edge() && edge.direction.cross(at - edge.start) < radius - margin;
            if behind {
                self.defects.push(Defect::OutsideZone { keypoint, site: number, at });
            }
        }
        if self.defects.len() > before {
            return;
        }
        let nearer = self.context.tree.near(at, radius, |edge| {
            if self.context.distance(at, edge) < radius - margin {
                ControlFlow::Break(Site::edge(edge))
            } else {
                ControlFlow::Continue(())
            }
        });
        if let Some(site) = nearer {
            let by = Name::of(self.context.domain, site);
            self.defects.push(Defect::Cut { keypoint, by, at });
        }
    }
}
