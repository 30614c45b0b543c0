//! Memory of this process, as far as the system tells.

/// Memory held now and the most held so far, in bytes; `None` where there is no `/proc`.
pub fn resident() -> Option<(f64, f64)> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let bytes = |name: &str| {
        let line = status.lines().find_map(|line| line.strip_prefix(name))?;
        Some(1024.0 * line.trim().strip_suffix("kB")?.trim().parse::<f64>().ok()?)
    };
    Some((bytes("VmRSS:")?, bytes("VmHWM:")?))
}
