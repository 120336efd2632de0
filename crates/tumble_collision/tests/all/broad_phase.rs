//! The broad phase against its oracle, and its growth.

use glam::{DVec2, DVec3};
use proptest::prelude::{Just, ProptestConfig, Strategy, any, prop_oneof, proptest};
use proptest::{collection, test_runner::RngSeed};
use tumble_collision::{BroadPhase, PairChanges, Volume};
use tumble_math::Bounds;
use tumble_team::Team;

/// Same cases every time.
fn config(cases: u32) -> ProptestConfig {
    ProptestConfig { cases, failure_persistence: None, rng_seed: RngSeed::Fixed(1), ..ProptestConfig::default() }
}

#[derive(Clone, Debug)]
enum Action {
    Insert(u32, Volume<DVec3>),
    Remove(u32),
    Move(u32, Volume<DVec3>, f64),
    Touch(u32),
    /// Pairs of ids whose sum leaves this remainder by 3 are filtered out from now on.
    Filter(u32),
    UpdatePairs,
}

fn volume() -> impl Strategy<Value = Volume<DVec3>> {
    let coordinate = || -5.0..5.0_f64;
    let point = move || (coordinate(), coordinate(), coordinate()).prop_map(|(x, y, z)| DVec3::new(x, y, z));
    let size = (0.0..2.0_f64, 0.0..2.0_f64, 0.0..6.0_f64).prop_map(|(x, y, z)| DVec3::new(x, y, z));
    let bounds = (point(), size).prop_map(|(min, size)| Volume::Box(Bounds { min, max: min + size }));
    let half_space = (point(), -9.0..0.0_f64).prop_map(|(direction, offset)| Volume::HalfSpace {
        normal: direction.try_normalize().unwrap_or(DVec3::Y),
        offset,
    });
    prop_oneof![9 => bounds, 1 => half_space]
}

fn action() -> impl Strategy<Value = Action> {
    let id = || 0..40_u32;
    prop_oneof![
        4 => (id(), volume()).prop_map(|(id, volume)| Action::Insert(id, volume)),
        2 => id().prop_map(Action::Remove),
        8 => (id(), volume(), 0.0..0.5_f64).prop_map(|(id, volume, margin)| Action::Move(id, volume, margin)),
        1 => id().prop_map(Action::Touch),
        1 => (0..4_u32).prop_map(Action::Filter),
        3 => Just(Action::UpdatePairs),
    ]
}

proptest! {
    #![proptest_config(config(300))]

    #[test]
    fn pairs_equal_all_pairs_after_any_history(actions in collection::vec(action(), 1..120), margin in 0.0..0.3_f64) {
        let mut broad_phase = BroadPhase::new();
        let mut changes = PairChanges::default();
        let mut listed = Vec::<(u32, u32)>::new();
        let mut unwanted = 3;
        for action in actions.into_iter().chain([Action::UpdatePairs]) {
            match action {
                Action::Insert(id, volume) => broad_phase.insert(id, volume, margin),
                Action::Remove(id) => broad_phase.remove(id),
                Action::Move(id, volume, margin) => broad_phase.update(id, volume, margin),
                Action::Touch(id) => broad_phase.touch(id),
                Action::Filter(remainder) => {
                    unwanted = remainder;
                    (0..40).for_each(|id| broad_phase.touch(id));
                }
                Action::UpdatePairs => {
                    let filter = |low: u32, high: u32| { assert!(low < high); (low + high) % 3 != unwanted };
                    broad_phase.update_pairs(filter, &mut changes);
                    // The changes, replayed, lead to the same set.
                    listed.retain(|pair| !changes.removed.contains(pair));
                    listed.extend(&changes.added);
                    listed.sort_unstable();
                    let oracle = broad_phase.all_pairs(filter);
                    assert_eq!(listed, oracle);
                    assert_eq!(broad_phase.pairs(), oracle);
                    assert!(changes.added.is_sorted() && changes.removed.is_sorted());
                }
            }
        }
    }

    #[test]
    fn pairs_do_not_depend_on_the_order_of_insertion(volumes in collection::vec(volume(), 2..60), seed in any::<u64>()) {
        let pairs = |order: &[usize]| {
            let mut broad_phase = BroadPhase::new();
            order.iter().for_each(|&i| broad_phase.insert(i as u32, volumes[i], 0.1));
            let mut changes = PairChanges::default();
            broad_phase.update_pairs(|_, _| true, &mut changes);
            changes.added
        };
        let order: Vec<usize> = (0..volumes.len()).collect();
        let mut shuffled = order.clone();
        shuffled.sort_by_key(|&i| (i as u64 + 1).wrapping_mul(seed | 1));
        assert_eq!(pairs(&order), pairs(&shuffled));
    }
}

#[test]
fn proxy_on_its_way_keeps_its_fat_volume_as_far_as_it_was_expected_to_travel() {
    let mut broad_phase = BroadPhase::new();
    let travel = DVec2::new(2.0, 0.0);
    broad_phase.update_moving(0, unit_box(DVec2::ZERO), travel, 0.1);
    let fat = broad_phase.fat_volume(0);
    broad_phase.update_moving(0, unit_box(travel), travel, 0.1);
    assert_eq!(broad_phase.fat_volume(0), fat, "where it was expected");
    broad_phase.update_moving(0, unit_box(travel * 1.1), travel, 0.1);
    assert_ne!(broad_phase.fat_volume(0), fat, "further than that");
}

#[test]
fn box_that_stopped_gets_a_close_fat_volume_again() {
    let mut broad_phase = BroadPhase::new();
    broad_phase.update_moving(0, unit_box(DVec2::ZERO), DVec2::new(2.0, 0.0), 0.1);
    broad_phase.update_moving(0, unit_box(DVec2::ZERO), DVec2::ZERO, 0.1);
    assert_eq!(broad_phase.fat_volume(0), Some(unit_box(DVec2::ZERO).grown(0.1)));
}

fn unit_box(centre: DVec2) -> Volume<DVec2> {
    Volume::Box(Bounds { min: centre - DVec2::splat(0.5), max: centre + DVec2::splat(0.5) })
}

#[test]
fn movement_inside_the_fat_volume_changes_nothing_and_leaving_it_does() {
    let mut broad_phase = BroadPhase::new();
    let mut changes = PairChanges::default();
    broad_phase.insert(0, unit_box(DVec2::ZERO), 0.1);
    broad_phase.insert(1, unit_box(DVec2::new(1.15, 0.0)), 0.1);
    broad_phase.update_pairs(|_, _| true, &mut changes);
    assert_eq!(changes.added, [(0, 1)]);
    let fat = broad_phase.fat_volume(1);

    broad_phase.update(1, unit_box(DVec2::new(1.24, 0.0)), 0.1);
    broad_phase.update_pairs(|_, _| true, &mut changes);
    assert_eq!((broad_phase.fat_volume(1), changes.clone()), (fat, PairChanges::default()));

    broad_phase.update(1, unit_box(DVec2::new(1.3, 0.0)), 0.1);
    broad_phase.update_pairs(|_, _| true, &mut changes);
    assert_eq!(changes.removed, [(0, 1)]);
}

#[test]
fn a_fat_volume_shrinks_again_when_its_margin_does() {
    let mut broad_phase = BroadPhase::new();
    broad_phase.insert(0, unit_box(DVec2::ZERO), 5.0);
    broad_phase.update(0, unit_box(DVec2::ZERO), 0.1);
    assert_eq!(broad_phase.fat_volume(0), Some(unit_box(DVec2::ZERO).grown(0.1)));
}

#[test]
fn a_proxy_replaced_under_the_same_id_ends_its_pairs_and_begins_new_ones() {
    let mut broad_phase = BroadPhase::new();
    let mut changes = PairChanges::default();
    broad_phase.insert(3, unit_box(DVec2::ZERO), 0.0);
    broad_phase.insert(7, unit_box(DVec2::X), 0.0);
    broad_phase.update_pairs(|_, _| true, &mut changes);
    broad_phase.remove(7);
    broad_phase.insert(7, unit_box(DVec2::Y), 0.0);
    broad_phase.update_pairs(|_, _| true, &mut changes);
    assert_eq!((&changes.removed[..], &changes.added[..]), (&[(3, 7)][..], &[(3, 7)][..]));
}

#[test]
fn half_spaces_pair_with_boxes_that_reach_them_and_never_with_each_other() {
    let mut broad_phase = BroadPhase::new();
    let mut changes = PairChanges::default();
    broad_phase.insert(0, Volume::HalfSpace { normal: DVec2::Y, offset: 0.0 }, 0.0);
    broad_phase.insert(1, Volume::HalfSpace { normal: DVec2::X, offset: 0.0 }, 0.0);
    broad_phase.insert(2, unit_box(DVec2::new(3.0, 0.5)), 0.0);
    broad_phase.insert(3, unit_box(DVec2::new(3.0, 1.5)), 0.0);
    broad_phase.update_pairs(|_, _| true, &mut changes);
    assert_eq!(changes.added, [(0, 2), (2, 3)]);
    broad_phase.update(0, Volume::HalfSpace { normal: DVec2::Y, offset: 1.0 }, 0.0);
    broad_phase.update_pairs(|_, _| true, &mut changes);
    assert_eq!(changes.added, [(0, 3)]);
}

#[test]
fn volumes_that_are_not_finite_pair_with_nothing_and_do_no_harm() {
    let mut broad_phase = BroadPhase::new();
    let mut changes = PairChanges::default();
    for id in 0..20 {
        let x = if id % 3 == 0 { f64::NAN } else { f64::from(id) };
        broad_phase.insert(id, unit_box(DVec2::new(x, 0.0)), 0.1);
    }
    broad_phase.update_pairs(|_, _| true, &mut changes);
    assert_eq!(changes.added, [(1, 2), (4, 5), (7, 8), (10, 11), (13, 14), (16, 17)]);
}

#[test]
fn a_crowd_is_refused_and_leaves_the_pairs_as_they_were() {
    let mut broad_phase = BroadPhase::new();
    let mut changes = PairChanges::default();
    broad_phase.insert(0, unit_box(DVec2::ZERO), 0.1);
    broad_phase.insert(1, unit_box(DVec2::ZERO), 0.1);
    broad_phase.share_pairs(&Team::alone(), |_, _| true, 1, &mut changes).unwrap();
    // Ten more in the same place: 65 new pairs; another stands by itself.
    (2..12).for_each(|id| broad_phase.insert(id, unit_box(DVec2::ZERO), 0.1));
    broad_phase.insert(12, unit_box(DVec2::new(50.0, 0.0)), 0.1);
    let crowd = broad_phase.share_pairs(&Team::alone(), |_, _| true, 64, &mut changes).unwrap_err();
    assert_eq!((crowd.proxy, crowd.of_proxy), (2, 11));
    assert_eq!(broad_phase.pairs(), [(0, 1)]);
    assert!(changes.added.is_empty() && changes.removed.is_empty());
    broad_phase.share_pairs(&Team::alone(), |_, _| true, 65, &mut changes).unwrap();
    assert_eq!(broad_phase.pairs(), broad_phase.all_pairs(|_, _| true));
}
