//! What a bake computes: how much of it, and what need not be computed twice.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};

use crate::store::{Cache, Key};
use lobefit_truth::quantity::Truth;
use serde::Serialize;
use serde::de::DeserializeOwned;

/// Counts the truths that were integrated, which is how `bake` shows that nothing is computed which
/// the scene does not call for, and keeps results for who asks for the same again.
#[derive(Debug, Default)]
pub struct Memo<'a> {
    integrals: AtomicU64,
    cache: Option<&'a Cache>,
    truths: Mutex<BTreeMap<String, Truth>>,
}

impl<'a> Memo<'a> {
    /// With a cache that outlasts it, or none.
    pub fn new(cache: Option<&'a Cache>) -> Memo<'a> {
        Memo { cache, ..Memo::default() }
    }

    /// The cache.
    pub fn cache(&self) -> Option<&'a Cache> {
        self.cache
    }

    /// Notes `n` integrated points.
    pub fn add(&self, n: usize) {
        self.integrals.fetch_add(n as u64, Ordering::Relaxed);
    }

    /// Points integrated so far.
    pub fn total(&self) -> u64 {
        self.integrals.load(Ordering::Relaxed)
    }

    /// What the cache has of a key, else what is made now, which is put there. What JSON cannot hold
    /// is made each time.
    pub fn kept<T, E>(&self, key: Key, make: impl FnOnce() -> Result<T, E>) -> Result<T, E>
    where
        T: Serialize + DeserializeOwned,
    {
        let Some(cache) = self.cache else { return make() };
        let key = key.end();
        if let Some(known) = cache.get(&key).and_then(|bytes| serde_json::from_slice(&bytes).ok()) {
            return Ok(known);
        }
        let made = make()?;
        if let Ok(bytes) = serde_json::to_vec(&made) {
            cache.put(&key, &bytes);
        }
        Ok(made)
    }

    /// The truth of a key, for which nothing is evaluated where it is known already; in the cache only
    /// where it `lasts`.
    pub fn truth<E>(
        &self,
        key: Key,
        lasts: bool,
        make: impl FnOnce() -> Result<Truth, E>,
    ) -> Result<Truth, E> {
        let name = key.clone().end();
        if let Some(known) = self.truths.lock().unwrap_or_else(PoisonError::into_inner).get(&name) {
            return Ok(Truth { evaluations: 0, ..known.clone() });
        }
        // None of what is known.
        let mut evaluated = 0;
        let make = || {
            let Truth { columns, error, evaluations } = make()?;
            evaluated = evaluations;
            Ok((columns, error))
        };
        let (columns, error) = if lasts { self.kept(key, make) } else { make() }?;
        let truth = Truth { columns, error, evaluations: evaluated };
        self.truths.lock().unwrap_or_else(PoisonError::into_inner).insert(name, truth.clone());
        Ok(truth)
    }
}
