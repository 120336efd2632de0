//! Teams of any size do the same work.

use std::sync::atomic::{AtomicUsize, Ordering};

use tumble_team::Team;

#[test]
fn every_task_is_done_once_whatever_the_size_of_the_team() {
    for threads in 1..=4 {
        let team = Team::new(threads).unwrap();
        assert_eq!(team.size(), threads);
        let mut list = vec![0_usize; 1000];
        team.enter(|| {
            team.share(list.chunks_mut(7).enumerate(), |(chunk, part)| {
                for (place, number) in part.iter_mut().enumerate() {
                    *number += chunk * 7 + place;
                }
            });
        });
        assert!(list.iter().enumerate().all(|(place, number)| place == *number), "{threads} threads");
    }
}

#[test]
fn a_barrier_keeps_phases_apart() {
    // Each member adds 1 in every phase: behind the barrier the sum is that of whole phases.
    for threads in 1..=4 {
        let team = Team::new(threads).unwrap();
        let sum = AtomicUsize::new(0);
        team.together(0..threads, |_, barrier| {
            for phase in 1..=500 {
                sum.fetch_add(1, Ordering::Relaxed);
                barrier.wait();
                assert_eq!(sum.load(Ordering::Relaxed), phase * threads);
                barrier.wait();
            }
        });
    }
}

#[test]
#[should_panic(expected = "panicked")]
fn a_member_that_panics_takes_the_others_along() {
    let team = Team::new(2).unwrap();
    team.together(0..2, |member, barrier| {
        assert!(member == 0, "this one panicked");
        barrier.wait();
    });
}

#[test]
#[should_panic(expected = "the work panicked")]
fn work_that_panics_lets_the_others_go() {
    Team::new(3).unwrap().enter(|| panic!("the work panicked"));
}

#[test]
fn work_is_always_entered_by_the_same_thread() {
    let team = Team::new(3).unwrap();
    let first = team.enter(|| std::thread::current().id());
    assert!((0..20).all(|_| team.enter(|| std::thread::current().id()) == first));
}

#[test]
#[should_panic(expected = "3 shares for 2 threads")]
fn more_shares_than_threads_would_never_meet() {
    Team::new(2).unwrap().together(0..3, |_, barrier| barrier.wait());
}
