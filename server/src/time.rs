//! Times, as the library keeps and compares them.

use std::time::SystemTime;

use espalier_proto::NotAllowed;
use serde::Deserialize;

/// The present time.
pub fn now() -> String {
    written(SystemTime::now())
}

/// A time that somebody asks for, in the form of `saved_at`.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(try_from = "String")]
pub struct Time(pub String);

impl TryFrom<String> for Time {
    type Error = NotAllowed;

    fn try_from(text: String) -> Result<Self, NotAllowed> {
        match humantime::parse_rfc3339(&text) {
            Ok(time) => Ok(Self(written(time))),
            Err(_) => Err(NotAllowed::new(text, "a time in UTC from 1970 to 9999, as 2026-01-31T12:30:00Z")),
        }
    }
}

/// With milliseconds always, for times are compared as text.
pub fn written(time: SystemTime) -> String {
    humantime::format_rfc3339_millis(time).to_string()
}

/// A time for people to read, to the minute: `2026-01-31 12:30 UTC`; what is no time stays as it is.
pub fn readable(time: &str) -> String {
    match humantime::parse_rfc3339(time) {
        Ok(time) => {
            let text = humantime::format_rfc3339_seconds(time).to_string();
            text.get(..16).map_or_else(|| text.clone(), |minute| format!("{} UTC", minute.replace('T', " ")))
        }
        Err(_) => time.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn people_read_times_to_the_minute() {
        assert_eq!(readable("2026-05-01T12:34:56.789Z"), "2026-05-01 12:34 UTC");
        assert_eq!(readable("soon"), "soon");
    }

    #[test]
    fn lb7_a_time_is_taken_in_one_form() {
        let read = |text: &str| Time::try_from(text.to_owned()).map(|time| time.0);
        for text in ["2026-01-31T12:30:00Z", "2026-01-31T12:30:00.000Z", "2026-01-31T12:30:00.0004Z"] {
            assert_eq!(read(text).as_deref(), Ok("2026-01-31T12:30:00.000Z"), "{text}");
        }
        for text in [
            "",
            "soon",
            "2000",
            "2026-01-31",
            "2026-02-31T12:00:00Z",
            "2026-01-31T12:30:00+01:00",
            "1969-12-31T12:00:00Z",
        ] {
            assert!(read(text).is_err_and(|fault| fault.allowed.contains("UTC")), "{text}");
        }
        let saved_at = now();
        assert_eq!(read(&saved_at), Ok(saved_at));
    }
}
