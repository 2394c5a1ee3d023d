//! How much memory there is: what was said, what the container may have, what the machine has.

use std::{fmt, fs, path::Path, str::FromStr};

/// Kept for what is not counted: the program itself, stacks, what the heap keeps, the database's cache.
const UNCOUNTED: u64 = 256 << 20;
/// Of a small limit no more than one part in so many is kept for that.
const UNCOUNTED_SHARE: u64 = 4;
/// Where the system does not tell how much there is.
const UNTOLD: u64 = 4 << 30;

/// A number of bytes as people write it: `512M`, `2G`, or plain bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bytes(pub u64);

impl FromStr for Bytes {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let text = text.trim();
        let number = text.trim_end_matches(|c: char| c.is_ascii_alphabetic());
        let shift = match text[number.len()..].to_ascii_lowercase().as_str() {
            "" | "b" => 0,
            "k" | "kb" | "kib" => 10,
            "m" | "mb" | "mib" => 20,
            "g" | "gb" | "gib" => 30,
            "t" | "tb" | "tib" => 40,
            _ => return Err("write it as 512M, 2G or a number of bytes".into()),
        };
        let count: u64 = number.trim().parse().map_err(|_| "write it as 512M, 2G or a number of bytes")?;
        count.checked_mul(1 << shift).map(Self).ok_or_else(|| "that is more than any machine has".into())
    }
}

/// Whose limit is the least.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// `--memory`.
    Said,
    /// The control group that the server runs in: a container, or a unit of the system.
    Container,
    /// Three quarters of the machine's memory.
    Machine,
    /// Nobody tells.
    Untold,
}

impl fmt::Display for Source {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Said => "--memory",
            Self::Container => "the limit of its control group",
            Self::Machine => "three quarters of the machine's memory",
            Self::Untold => "a guess, for the system does not tell",
        })
    }
}

/// The least of all limits, and whose it is.
pub fn least(said: Option<Bytes>, container: Option<u64>, machine: Option<u64>) -> (u64, Source) {
    let said = said.map(|Bytes(bytes)| (bytes, Source::Said));
    let container = container.map(|bytes| (bytes, Source::Container));
    let machine = machine.map(|bytes| (bytes / 4 * 3, Source::Machine));
    let all = [said, container, machine].into_iter().flatten();
    all.min_by_key(|(bytes, _)| *bytes).unwrap_or((UNTOLD, Source::Untold))
}

/// What of a limit may be taken for what is counted.
pub fn to_be_taken(limit: u64) -> u64 {
    limit - UNCOUNTED.min(limit / UNCOUNTED_SHARE)
}

/// The limit of this process' control group and of those above it, if there is any.
pub fn of_container() -> Option<u64> {
    let groups = fs::read_to_string("/proc/self/cgroup").ok()?;
    groups_of(&groups).iter().filter_map(|(file, group)| least_above(Path::new(file), group)).min()
}

/// The least limit of a group and of all above it, as its root sees them.
fn least_above(root: &Path, group: &str) -> Option<u64> {
    let file = if root.ends_with("memory") { "memory.limit_in_bytes" } else { "memory.max" };
    let group = root.join(group.trim_start_matches('/'));
    let above = group.ancestors().take_while(|folder| folder.starts_with(root));
    above.filter_map(|folder| limit_in(&fs::read_to_string(folder.join(file)).ok()?)).min()
}

/// Where limits of memory stand for the groups that `/proc/self/cgroup` tells.
fn groups_of<'a>(told: &'a str) -> Vec<(&'static str, &'a str)> {
    let group = |line: &'a str| {
        let mut fields = line.splitn(3, ':').skip(1);
        let (controllers, group) = (fields.next()?, fields.next()?);
        match controllers {
            "" => Some(("/sys/fs/cgroup", group)),
            some if some.split(',').any(|one| one == "memory") => Some(("/sys/fs/cgroup/memory", group)),
            _ => None,
        }
    };
    told.lines().filter_map(group).collect()
}

/// A limit as a control group writes it; none where it has none.
fn limit_in(text: &str) -> Option<u64> {
    // The first version writes the largest number of pages for none.
    text.trim().parse().ok().filter(|&bytes| bytes < 1 << 60)
}

/// The memory of the machine, if the system tells.
pub fn of_machine() -> Option<u64> {
    total_in(&fs::read_to_string("/proc/meminfo").ok()?)
}

fn total_in(told: &str) -> Option<u64> {
    let line = told.lines().find_map(|line| line.strip_prefix("MemTotal:"))?;
    let kilobytes: u64 = line.trim().trim_end_matches("kB").trim().parse().ok()?;
    kilobytes.checked_mul(1024)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_read_as_people_write_them() {
        for (text, bytes) in [
            ("0", 0),
            ("4096", 4096),
            ("512M", 512 << 20),
            ("2g", 2 << 30),
            ("3 GiB", 3 << 30),
            ("1kB", 1024),
        ] {
            assert_eq!(text.parse(), Ok(Bytes(bytes)), "{text}");
        }
        for text in ["", "M", "-1", "1.5G", "2 apples", "99999999999T"] {
            assert!(text.parse::<Bytes>().is_err(), "{text}");
        }
    }

    #[test]
    fn lm19_the_least_limit_counts() {
        let gigabytes = |count: u64| count << 30;
        assert_eq!(least(None, None, Some(gigabytes(8))), (gigabytes(6), Source::Machine));
        let container = Some(gigabytes(2));
        assert_eq!(least(None, container, Some(gigabytes(8))), (gigabytes(2), Source::Container));
        let said = Some(Bytes(gigabytes(1)));
        assert_eq!(least(said, container, Some(gigabytes(8))), (gigabytes(1), Source::Said));
        assert_eq!(least(Some(Bytes(gigabytes(9))), container, None).1, Source::Container);
        assert_eq!(least(None, None, None), (UNTOLD, Source::Untold));
        assert_eq!(to_be_taken(gigabytes(2)), gigabytes(2) - UNCOUNTED);
        assert_eq!(to_be_taken(400 << 20), 300 << 20, "something is left of a small limit");
    }

    #[test]
    fn limits_are_read_as_the_system_writes_them() {
        assert_eq!(limit_in("536870912\n"), Some(536_870_912));
        assert_eq!(limit_in("max\n"), None);
        assert_eq!(limit_in("9223372036854771712\n"), None, "the first version's none");
        assert_eq!(total_in("MemTotal:       24689712 kB\nMemFree: 1 kB\n"), Some(24_689_712 * 1024));
        assert_eq!(total_in("MemFree: 1 kB\n"), None);
        assert_eq!(groups_of("0::/user.slice/a\n"), [("/sys/fs/cgroup", "/user.slice/a")]);
        let first = "12:cpu,cpuacct:/x\n5:memory:/docker/ab\n0::/y\n";
        assert_eq!(groups_of(first), [("/sys/fs/cgroup/memory", "/docker/ab"), ("/sys/fs/cgroup", "/y")]);
    }

    #[test]
    fn a_group_has_the_limits_of_those_above_it() {
        let root = tempfile::tempdir().unwrap();
        let inner = root.path().join("slice/unit");
        fs::create_dir_all(&inner).unwrap();
        fs::write(inner.join("memory.max"), "max\n").unwrap();
        assert_eq!(least_above(root.path(), "/slice/unit"), None);
        fs::write(root.path().join("slice/memory.max"), "1048576\n").unwrap();
        assert_eq!(least_above(root.path(), "/slice/unit"), Some(1 << 20));
        fs::write(inner.join("memory.max"), "4096\n").unwrap();
        assert_eq!(least_above(root.path(), "/slice/unit"), Some(4096));
    }
}
