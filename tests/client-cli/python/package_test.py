"""The doctests of the package."""
import doctest
import importlib
import pkgutil
import unittest

import cellcrush


def load_tests(loader, tests, pattern):
    for module in pkgutil.iter_modules(cellcrush.__path__):
        if not module.ispkg:
            tests.addTests(doctest.DocTestSuite(importlib.import_module(f"cellcrush.{module.name}")))
    return tests


if __name__ == "__main__":
    unittest.main()
