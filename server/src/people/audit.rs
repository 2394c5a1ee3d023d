//! `espalier audit`: what was done.

use super::{PeopleError, at, print};
use crate::{
    cli,
    http::described,
    store::{Audit, Event, Noted},
};

/// `espalier audit`.
pub fn audit(options: &cli::Audit) -> Result<(), PeopleError> {
    let events = at(&options.database.path, async |store| Ok(store.events(options.limit, None).await?))?;
    for event in events {
        if options.json {
            // Plain values always have a JSON form.
            print(&serde_json::to_string(&described(event)).unwrap_or_default());
        } else {
            let Noted { event: Event { at, who, address, action, object, outcome }, times, last_at, .. } =
                event;
            let from = address.map(|address| format!(" from {address}")).unwrap_or_default();
            let object = object.map(|object| format!(" {object}")).unwrap_or_default();
            let again = last_at.map(|last| format!(", {times} times until {last}")).unwrap_or_default();
            print(&format!("{at}  {who}{from}: {action}{object}: {outcome}{again}"));
        }
    }
    Ok(())
}
