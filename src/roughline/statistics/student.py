"""Student's t: how uncertain the mean of a few values is."""


def student(count: int) -> float:
    """Half width of the interval of the mean of so many values, over its standard error, at 95 %.

    The values are independent and scatter normally; there are two or more.
    """
    from scipy.special import stdtrit  # here because it loads slowly

    return float(stdtrit(count - 1, 0.975))
