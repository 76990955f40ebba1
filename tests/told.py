"""What is told with results, as tests look for it."""


def first_warning(result):
    """The first of the warnings that are not grave; grave ones stand above all others."""
    return next(str(each) for each in result.facts if each.weight == "warning")
