//! Sizes of buffers and dispatches.

mod common;

use tess_gpu::{Capacity, Limits, Plan};

/// WebGPU's limits: chunks and windows end before a dispatch has as many workgroups in a row.
#[test]
fn default_limits_need_no_rows() {
    let all = Capacity { points: u32::MAX, primitives: u32::MAX };
    for setup in common::all_setups() {
        let plan = Plan::new(setup, u32::MAX, all, Limits::WEBGPU);
        let [_, rows, _] = plan.factors_workgroups(0);
        let tiles = [plan.point_job(0, 0).window_tiles, plan.primitive_job(0, 0).window_tiles];
        assert!(rows == 1 && tiles.into_iter().all(|tiles| tiles < 65536), "{setup:?}: {plan:?}");
    }
}
