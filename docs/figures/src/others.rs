//! What other programs took of the processors while figures were made: it disturbs times. Only Linux says it.

use std::fs;

/// Processor time so far, in the system's clock ticks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment {
    /// Of all processors, at work.
    busy: u64,
    /// Of all processors, at work or not.
    all: u64,
    /// How many there are.
    processors: u64,
    /// Of this program and of what it started and has ended.
    own: u64,
}

impl Moment {
    /// Now.
    pub fn now() -> Option<Self> {
        let read = |path: &str| fs::read_to_string(path).ok();
        Self::parse(&read("/proc/stat")?, &read("/proc/self/stat")?)
    }

    fn parse(system: &str, process: &str) -> Option<Self> {
        let total = system.lines().next()?.strip_prefix("cpu ")?;
        // user, nice, system, idle, iowait, irq, softirq, steal; guests are in user.
        let times: Vec<u64> = total.split_whitespace().take(8).map(str::parse).collect::<Result<_, _>>().ok()?;
        let all: u64 = times.iter().sum();
        let idle = times.get(3)? + times.get(4)?;
        let processors = system.lines().skip(1).filter(|line| line.starts_with("cpu")).count() as u64;
        // The name may have spaces and brackets; after it come state, …, and as the 12th to the 15th the times.
        let fields = process.rsplit_once(')')?.1.split_whitespace();
        let own: Vec<u64> = fields.skip(11).take(4).map(str::parse).collect::<Result<_, _>>().ok()?;
        Some(Self { busy: all - idle, all, processors, own: own.iter().sum() })
    }

    /// Words for what others took since, on average.
    pub fn others_until(self, end: Self) -> String {
        let all = end.all.saturating_sub(self.all).max(1) as f64;
        let others = (end.busy.saturating_sub(self.busy)).saturating_sub(end.own.saturating_sub(self.own)) as f64;
        let processors = end.processors;
        format!("other work {:.2} of {processors} processors", others / all * processors as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_not_our_own_is_others() {
        let moment = |user: u64, idle: u64, own: u64| {
            let system = format!("cpu  {user} 10 20 {idle} 5 1 1 0 0 0\ncpu0 1 2\ncpu1 1 2\nintr 1\n");
            let process = format!("7 (a (b) c) S 1 2 3 4 5 6 7 8 9 10 {own} 3 40 5 20 0\n");
            Moment::parse(&system, &process).unwrap()
        };
        let begin = moment(100, 1000, 30);
        assert_eq!(begin.others_until(moment(200, 1100, 130)), "other work 0.00 of 2 processors");
        assert_eq!(begin.others_until(moment(200, 1100, 80)), "other work 0.50 of 2 processors");
        assert_eq!(Moment::parse("", ""), None);
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn this_system_says_it() {
        let begin = Moment::now().unwrap();
        assert!(begin.processors > 0 && begin.busy <= begin.all);
    }
}
