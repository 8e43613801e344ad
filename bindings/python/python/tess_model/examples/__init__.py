"""Examples: :mod:`tess_model.examples.cocotb`, a bench in cocotb, and :mod:`tess_model.examples.campaign_on_dask`."""
