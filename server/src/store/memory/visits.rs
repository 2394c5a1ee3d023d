//! Who has been in which session, in the model.

use super::{
    super::{LineTree, SessionLine, SessionQuery, StoreError, Visits},
    Kept, MemoryStore, Session,
};

impl Visits for MemoryStore {
    async fn visit(&self, session: &str, person: &str) -> Result<(), StoreError> {
        if let Some(session) = self.writing()?.sessions.get_mut(session) {
            session.people.insert(person.to_owned());
            session.is_forgotten = false;
        }
        Ok(())
    }

    async fn sessions(&self, query: &SessionQuery) -> Result<Vec<SessionLine>, StoreError> {
        let kept = self.kept();
        let listed = kept.sessions.iter().filter(|(_, session)| {
            let is_theirs = query.person.as_ref().is_none_or(|person| session.people.contains(person));
            let is_of_tree = query
                .tree
                .as_ref()
                .is_none_or(|tree| session.tree.as_ref().is_some_and(|(of, _)| of == tree));
            let is_seen = query
                .seen_by
                .as_ref()
                .is_none_or(|person| session.tree.as_ref().is_some_and(|(of, _)| kept.is_seen(of, person)));
            is_theirs && is_of_tree && is_seen && !session.is_forgotten
        });
        let mut lines: Vec<_> = listed.map(|(name, session)| line(&kept, name, session)).collect();
        lines.retain(|line| query.is_saved.is_none_or(|is_saved| line.is_saved == is_saved));
        let key = |line: &SessionLine| (line.used_at.clone(), line.name.clone());
        if let Some(after) = &query.after {
            let after = (after.used_at.clone(), after.name.clone());
            lines.retain(|line| key(line) < after);
        }
        lines.sort_by_key(|line| std::cmp::Reverse(key(line)));
        lines.truncate(query.limit as usize);
        Ok(lines)
    }

    async fn forget_session(&self, session: &str, person: Option<&str>) -> Result<bool, StoreError> {
        let mut kept = self.writing()?;
        let Some(session) = kept.sessions.get_mut(session) else { return Ok(false) };
        Ok(match person {
            Some(person) => session.people.remove(person),
            None => !std::mem::replace(&mut session.is_forgotten, true),
        })
    }
}

fn line(kept: &Kept, name: &str, session: &Session) -> SessionLine {
    let of = session.tree.as_ref().and_then(|(id, version)| Some((id, kept.trees.get(id)?, *version)));
    let tree = of.map(|(id, tree, version)| LineTree { id: id.clone(), name: tree.name.clone(), version });
    let is_whole = tree.is_some() || session.row.last_entry == 0;
    SessionLine {
        name: name.to_owned(),
        is_saved: session.row.last_entry <= session.saved_through && is_whole,
        tree,
        metamers: session.metamers,
        used_at: session.entered_at.clone(),
    }
}
