"""The study of finite size: where the power law ends and the linear law begins."""
