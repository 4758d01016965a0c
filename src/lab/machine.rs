//! The machine that figures were measured on.

/// Name of the processor; only on Linux.
pub fn processor() -> String {
    std::fs::read_to_string("/proc/cpuinfo")
        .ok()
        .and_then(|text| {
            let name = text.lines().find(|line| line.starts_with("model name"))?.split_once(':')?.1;
            Some(name.trim().to_owned())
        })
        .unwrap_or_else(|| "unknown processor".to_owned())
}
