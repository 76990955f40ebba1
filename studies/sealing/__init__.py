"""The study of sealing: at which contact area the last channel closes, and what leaks before."""
