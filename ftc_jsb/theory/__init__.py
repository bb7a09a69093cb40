"""Sections 2-4 of the paper for any x' = F(x, u, k), y = h(x): symbols in, kernels and numbers out."""
