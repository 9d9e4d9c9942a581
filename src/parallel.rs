//! Loops over independent work: on all threads with the feature `parallel`, one after the other without it.
//!
//! Every function gives its results in the order of the work, whichever thread did it: so both ways give the
//! same, bit by bit, as long as one piece of work does not see another's. Nothing else of the library knows
//! of threads.

#[cfg(feature = "parallel")]
use rayon::prelude::*;

/// What `work` makes of each number below `count`, in their order.
pub fn map<T: Send>(count: usize, work: impl Fn(usize) -> T + Sync + Send) -> Vec<T> {
    #[cfg(feature = "parallel")]
    {
        (0..count).into_par_iter().map(work).collect()
    }
    #[cfg(not(feature = "parallel"))]
    {
        (0..count).map(work).collect()
    }
}

/// Does `work` for each number below `count`.
pub fn for_each(count: usize, work: impl Fn(usize) + Sync + Send) {
    #[cfg(feature = "parallel")]
    (0..count).into_par_iter().for_each(work);
    #[cfg(not(feature = "parallel"))]
    (0..count).for_each(work);
}

/// Does `work` for each item and its place, from 0.
pub fn for_each_mut<T: Send>(items: &mut [T], work: impl Fn(usize, &mut T) + Sync + Send) {
    #[cfg(feature = "parallel")]
    items.par_iter_mut().enumerate().for_each(|(i, item)| work(i, item));
    #[cfg(not(feature = "parallel"))]
    items.iter_mut().enumerate().for_each(|(i, item)| work(i, item));
}

/// Does `work` for each number below `count` until one fails; any of those that failed is returned. Each
/// number is handed to a thread by itself, for work of very different length.
pub fn try_for_each<E: Send>(
    count: usize,
    work: impl Fn(usize) -> Result<(), E> + Sync + Send,
) -> Result<(), E> {
    #[cfg(feature = "parallel")]
    {
        (0..count).into_par_iter().with_max_len(1).try_for_each(work)
    }
    #[cfg(not(feature = "parallel"))]
    {
        (0..count).try_for_each(work)
    }
}

/// Both results.
pub fn join<A: Send, B: Send>(one: impl FnOnce() -> A + Send, other: impl FnOnce() -> B + Send) -> (A, B) {
    #[cfg(feature = "parallel")]
    {
        rayon::join(one, other)
    }
    #[cfg(not(feature = "parallel"))]
    {
        (one(), other())
    }
}

/// Sorts by a key; items of equal keys keep their order.
pub fn sort_by_key<T: Send, K: Ord>(items: &mut [T], key: impl Fn(&T) -> K + Sync) {
    #[cfg(feature = "parallel")]
    items.par_sort_by_key(key);
    #[cfg(not(feature = "parallel"))]
    items.sort_by_key(key);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_stand_in_the_order_of_the_work() {
        assert_eq!(map(1000, |i| i * i), (0..1000).map(|i| i * i).collect::<Vec<_>>());
        let mut items = vec![1; 1000];
        for_each_mut(&mut items, |i, item| *item += i);
        assert_eq!(items, (1..=1000).collect::<Vec<_>>());
        let mut pairs: Vec<(usize, usize)> = (0..1000).map(|i| (i % 7, i)).collect();
        sort_by_key(&mut pairs, |(key, _)| *key);
        assert!(pairs.is_sorted(), "equal keys keep their order");
        assert_eq!(join(|| 1, || 2), (1, 2));
    }

    #[test]
    fn work_ends_at_a_failure_and_is_whole_without() {
        use std::sync::atomic::{AtomicUsize, Ordering};
        let done = AtomicUsize::new(0);
        for_each(1000, |i| _ = done.fetch_add(i, Ordering::Relaxed));
        assert_eq!(done.into_inner(), 499_500);
        assert_eq!(try_for_each(1000, |i| if i == 617 { Err(i) } else { Ok(()) }), Err(617));
        assert_eq!(try_for_each(1000, |_| Ok::<(), usize>(())), Ok(()));
    }
}
