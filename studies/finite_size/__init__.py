"""The study of finite size: where the power law ends, and whether a linear law follows."""
