"""A bench in cocotb, with its design: ``python -m tess_model.examples.cocotb --sim icarus``.

To change it, copy this folder; ``python run.py`` runs the copy.
"""
