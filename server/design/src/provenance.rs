//! Where values come from (§2.1): the first branch on the way down in which the parameter is public.

use crate::{
    design::Design,
    graph::{From, Owner, ShareId, Source, Visibility},
    key::Key,
    node::NodeId,
};

/// Where a value comes from in the end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// Nobody said anything.
    Default,
    /// An owner says it.
    Owner(Owner),
    /// Several say it together.
    Share(ShareId),
}

/// How a branch has a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// It says it itself, or its level does.
    Own,
    /// It shares it.
    Shared,
    /// It says it relative to what it inherits.
    Relative,
    /// It inherits it.
    Inherited,
}

/// A branch on the way from the root to another, as a path of values shows it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stop {
    /// The branch.
    pub node: NodeId,
    /// How it has the value.
    pub status: Status,
    /// Who may inherit it.
    pub visibility: Visibility,
    /// Who says so: the branch, its level, or nobody.
    pub by: Option<Owner>,
    /// The branch that it inherits from, where it does.
    pub from: Option<NodeId>,
}

impl Design {
    /// How a branch that stands has a value.
    pub fn stop(&self, node: NodeId, key: Key) -> Option<Stop> {
        self.branch(node)?;
        let setting = self.graph().setting(node, key);
        let status = match setting.map(|(_, setting)| &setting.source) {
            Some(Source::Explicit(_)) => Status::Own,
            Some(Source::Shared(_)) => Status::Shared,
            Some(Source::Relative(..)) => Status::Relative,
            Some(Source::Inherited) | None => Status::Inherited,
        };
        let inherits = matches!(status, Status::Inherited | Status::Relative);
        Some(Stop {
            node,
            status,
            visibility: setting.map_or(Visibility::Public, |(_, setting)| setting.visibility),
            by: setting.map(|(owner, _)| owner),
            from: if inherits { self.heir_of(node, key) } else { None },
        })
    }

    /// How the branches from the root to one that stands have a value.
    pub fn path_strip(&self, node: NodeId, key: Key) -> Vec<Stop> {
        node.path().filter_map(|node| self.stop(node, key)).collect()
    }

    /// The branches that a value has come through, from the one that has it to the one that says it, and where it
    /// comes from. Relative values on the way have had their part in it.
    pub fn provenance(&self, node: NodeId, key: Key) -> Option<(Vec<NodeId>, Origin)> {
        let mut way = Vec::new();
        let mut next = self.stop(node, key)?;
        loop {
            way.push(next.node);
            let origin = match (next.status, next.by) {
                (Status::Own, Some(owner)) => Origin::Owner(owner),
                (Status::Shared, _) => {
                    match self.graph().setting(next.node, key).map(|(_, said)| &said.source) {
                        Some(&Source::Shared(share)) => Origin::Share(share),
                        _ => Origin::Default,
                    }
                }
                _ => match next.from.and_then(|from| self.stop(from, key)) {
                    Some(from) => {
                        next = from;
                        continue;
                    }
                    None => Origin::Default,
                },
            };
            return Some((way, origin));
        }
    }

    /// The branch that another inherits a parameter from; none for the root.
    fn heir_of(&self, node: NodeId, key: Key) -> Option<NodeId> {
        let is_public = |node: NodeId| {
            let said = self.graph().setting(node, key);
            said.is_none_or(|(_, setting)| setting.visibility == Visibility::Public)
        };
        let (bearer, _) = node.bearer()?;
        let from = self.graph().setting(node, key).map_or(From::Bearer, |(_, setting)| setting.from);
        let beneath = match from {
            From::Bearer => &[],
            From::Below => {
                let axis = self.branch(bearer)?.laterals();
                let at = axis.iter().position(|lateral| lateral.id() == node)?;
                &axis[..at]
            }
        };
        let beneath = beneath.iter().rev().map(|lateral| lateral.id());
        let below = std::iter::successors(Some(bearer), |below| Some(below.bearer()?.0));
        beneath.chain(below).find(|&node| is_public(node))
    }
}
