//! What the benchmarks share: the machine's name and its load, and the time a thread has had.

use std::time::Duration;

/// The processor's name as the system gives it, and how many other things are running.
pub fn machine() -> String {
    let read = |path| std::fs::read_to_string(path).unwrap_or_default();
    let (info, load) = (read("/proc/cpuinfo"), read("/proc/loadavg"));
    let said = |key: &str| {
        let line = info.lines().find_map(|l| l.strip_prefix(key)).unwrap_or(": not known");
        line.trim_start_matches([':', ' ', '\t']).to_owned()
    };
    let load = load.split(' ').next().unwrap_or("not known").to_owned();
    let threads = std::thread::available_parallelism().map_or(1, |n| n.get());
    format!(
        "{}, family {} model {}, {threads} threads; load {load}",
        said("model name"),
        said("cpu family"),
        said("model\t")
    )
}

/// Processor time that this thread has had: other programs on the machine do not count.
#[cfg(unix)]
pub fn thread_time() -> Duration {
    let t = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    Duration::new(t.tv_sec.unsigned_abs(), u32::try_from(t.tv_nsec).unwrap_or(0))
}

/// Time that has passed, where the system does not tell a thread's own.
#[cfg(not(unix))]
pub fn thread_time() -> Duration {
    static START: std::sync::LazyLock<std::time::Instant> = std::sync::LazyLock::new(std::time::Instant::now);
    START.elapsed()
}

/// The shortest of several runs in seconds of [`thread_time`], and what the last one gave.
pub fn best_of<T>(runs: usize, mut work: impl FnMut() -> T) -> (f64, T) {
    let mut timed = || {
        let start = thread_time();
        let result = work();
        ((thread_time() - start).as_secs_f64().max(1e-9), result)
    };
    let first = timed();
    (1..runs).fold(first, |best, _| {
        let next = timed();
        (best.0.min(next.0), next.1)
    })
}
