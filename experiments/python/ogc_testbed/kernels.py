"""Marks functions as kernels of stages, which `ogc compare STAGE --plugin FILE.py` judges."""


def kernel(stage):
    """Marks a function as kernel of a stage, such as "truncate".

    The function gets whole batches as arrays. Its parameters have the names of the members of the stage's structure in
    compare/plugin.h (`ogc_truncate_in`); it may leave some out. It returns the arrays of `ogc_truncate_out`, as a
    tuple in that order, as a dictionary by name, or, where there is one, the array itself. The function stays as it is.
    """
    if not isinstance(stage, str):
        raise TypeError('kernel takes the name of a stage: @kernel("truncate")')

    def mark(function):
        function.ogc_stages = (*getattr(function, "ogc_stages", ()), stage)
        return function

    return mark
