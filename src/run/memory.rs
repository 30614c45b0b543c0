//! Memory and processor time of this process, as far as the system tells.

/// Memory held now and the most held so far, in bytes; `None` where there is no `/proc`.
pub fn resident() -> Option<(f64, f64)> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let bytes = |name: &str| {
        let line = status.lines().find_map(|line| line.strip_prefix(name))?;
        Some(1024.0 * line.trim().strip_suffix("kB")?.trim().parse::<f64>().ok()?)
    };
    Some((bytes("VmRSS:")?, bytes("VmHWM:")?))
}

/// Ticks of the clock by which Linux tells processor times, one second.
const TICKS: f64 = 100.0;

/// Seconds that all threads of this process have had of the processor, ended ones among them; `None` where there is no `/proc`.
pub fn processor() -> Option<f64> {
    let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
    // The name of the program stands in brackets and may hold anything.
    let (_, rest) = stat.rsplit_once(')')?;
    // User and system time are the 14th and 15th of all cells, of which two are gone.
    let mut cells = rest.split_whitespace().skip(11);
    let mut ticks = || cells.next()?.parse::<f64>().ok();
    Some((ticks()? + ticks()?) / TICKS)
}
