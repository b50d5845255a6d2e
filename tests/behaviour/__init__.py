"""What a checkout does, saved as text and compared with what another one does, or the same after it was rebuilt.

`python -m behaviour save DIR` and `python -m behaviour compare BEFORE AFTER`. A kind is a module in `kinds/`: it uses
the product as its users do, mostly through its commands, and writes what it tells into a folder. `normalising.py` has
all that may differ. The product is the one that `PYTHONPATH` finds; the input is that of this folder's checkout.
"""
