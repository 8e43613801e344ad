//! The named workloads under Criterion.
