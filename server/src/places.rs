//! Places that one network alone cannot take: of connections, sockets and uploads.

use std::{
    collections::BTreeMap,
    net::IpAddr,
    sync::{Arc, Mutex, MutexGuard, PoisonError},
};

use ipnet::IpNet;

use crate::access::network;

/// A number of places. This machine itself and those who speak for many may take all of them, any other network a
/// share.
#[derive(Clone, Debug)]
pub struct Places(Arc<Inner>);

#[derive(Debug)]
struct Inner {
    most: usize,
    most_of_one: usize,
    /// Who speaks for many: proxies.
    for_many: Vec<IpNet>,
    taken: Mutex<Taken>,
}

#[derive(Debug, Default)]
struct Taken {
    all: usize,
    /// Those of each network that has any.
    by_network: BTreeMap<IpAddr, usize>,
}

/// One place, given back when it is dropped.
#[derive(Debug)]
pub struct Place {
    places: Places,
    network: Option<IpAddr>,
}

impl Places {
    /// So many places, of which one network has `most_of_one` at most.
    pub fn new(most: usize, most_of_one: usize) -> Self {
        Self::with_proxies(most, most_of_one, Vec::new())
    }

    /// The same, where those in these networks speak for many.
    pub fn with_proxies(most: usize, most_of_one: usize, for_many: Vec<IpNet>) -> Self {
        Self(Arc::new(Inner { most, most_of_one, for_many, taken: Mutex::default() }))
    }

    /// A place for somebody who comes from this address, if there is one.
    pub fn take(&self, from: IpAddr) -> Option<Place> {
        let from = from.to_canonical();
        let network = (!from.is_loopback() && !self.0.for_many.iter().any(|proxies| proxies.contains(&from)))
            .then(|| network(from));
        let mut taken = self.taken();
        let of_one = network.and_then(|network| taken.by_network.get(&network).copied()).unwrap_or(0);
        if taken.all >= self.0.most || of_one >= self.0.most_of_one {
            return None;
        }
        taken.all += 1;
        if let Some(network) = network {
            taken.by_network.insert(network, of_one + 1);
        }
        Some(Place { places: self.clone(), network })
    }

    /// How many are taken.
    pub fn count(&self) -> usize {
        self.taken().all
    }

    fn taken(&self) -> MutexGuard<'_, Taken> {
        self.0.taken.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        let mut taken = self.places.taken();
        taken.all -= 1;
        let Some(network) = self.network else { return };
        let of_one = taken.by_network.get(&network).map_or(0, |of_one| of_one - 1);
        if of_one == 0 {
            taken.by_network.remove(&network);
        } else {
            taken.by_network.insert(network, of_one);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(text: &str) -> IpAddr {
        text.parse().unwrap()
    }

    #[test]
    fn lm16_one_network_has_a_share() {
        let places = Places::new(5, 2);
        let first = places.take(at("10.0.0.1")).unwrap();
        let _second = places.take(at("::ffff:10.0.0.1")).unwrap();
        assert!(places.take(at("10.0.0.1")).is_none());
        let _other = places.take(at("10.0.0.2")).unwrap();
        let _third = places.take(at("2001:db8::1")).unwrap();
        let fourth = places.take(at("2001:db8::2")).unwrap();
        assert!(places.take(at("10.0.0.3")).is_none(), "all are taken");
        drop(fourth);
        drop(first);
        assert!(places.take(at("10.0.0.1")).is_some());
    }

    #[test]
    fn lm16_this_machine_may_take_all() {
        let places = Places::new(3, 1);
        let taken = ["127.0.0.1", "::1", "127.0.0.1"].map(|from| places.take(at(from)).unwrap());
        assert!(places.take(at("127.0.0.1")).is_none());
        drop(taken);
        assert!(places.taken().by_network.is_empty());
        assert_eq!(places.taken().all, 0);
    }

    #[test]
    fn lm16_a_trusted_proxy_may_take_all() {
        let places = Places::with_proxies(3, 1, vec!["10.0.0.0/8".parse().unwrap()]);
        let _taken = ["10.0.0.1", "::ffff:10.0.0.1"].map(|from| places.take(at(from)).unwrap());
        let _other = places.take(at("11.0.0.1")).unwrap();
        assert!(places.take(at("10.0.0.1")).is_none(), "all are taken");
    }
}
