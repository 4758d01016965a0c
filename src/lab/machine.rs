//! The machine that figures were measured on.

/// Memory of this process, bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Memory {
    /// What it has now.
    pub resident: u64,
    /// The most that it has had.
    pub peak: u64,
}

/// Memory of this process, as Linux counts it; only there.
pub fn memory() -> Option<Memory> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let bytes = |name: &str| {
        let line = status.lines().find_map(|line| line.strip_prefix(name))?;
        line.trim().strip_suffix(" kB")?.trim().parse::<u64>().ok().map(|kilobytes| kilobytes * 1024)
    };
    Some(Memory { resident: bytes("VmRSS:")?, peak: bytes("VmHWM:")? })
}

/// Name of the processor, with its family and model where the system has them: different processors have the same name. Only on
/// Linux.
pub fn processor() -> String {
    let found = std::fs::read_to_string("/proc/cpuinfo").ok().and_then(|text| name(&text));
    found.unwrap_or_else(|| "unknown processor".to_owned())
}

/// The first processor in Linux's list.
fn name(cpuinfo: &str) -> Option<String> {
    let field = |wanted: &str| {
        let fields = cpuinfo.lines().filter_map(|line| line.split_once(':'));
        fields
            .map(|(name, value)| (name.trim(), value.trim()))
            .find(|(name, _)| *name == wanted)
            .map(|(_, value)| value)
    };
    let name = field("model name")?;
    Some(match field("cpu family").zip(field("model")) {
        Some((family, model)) => format!("{name} (family {family}, model {model})"),
        None => name.to_owned(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn processors_that_go_by_one_name_are_told_apart() {
        let list = |model: u32| {
            format!(
                "processor\t: 0\nvendor_id\t: GenuineIntel\ncpu family\t: 6\nmodel\t\t: {model}\n\
                 model name\t: Intel(R) Xeon(R) Processor\nstepping\t: 1\n\nprocessor\t: 1\nmodel\t\t: 1\n"
            )
        };
        assert_eq!(name(&list(167)).unwrap(), "Intel(R) Xeon(R) Processor (family 6, model 167)");
        assert_ne!(name(&list(167)), name(&list(207)));
        assert_eq!(name("model name\t: ARMv7 Processor rev 4 (v7l)\n").unwrap(), "ARMv7 Processor rev 4 (v7l)");
        assert_eq!(name("processor\t: 0\nCPU implementer\t: 0x41\n"), None);
    }
}
