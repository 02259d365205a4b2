"""The doctests of the package, its page, and the examples of both."""
import doctest
import importlib
import os
import pkgutil
import re
import unittest

import cellcrush
from support import ROOT, WithServer

PAGE = ROOT / "client-cli/python/README.md"


def load_tests(loader, tests, pattern):
    for module in pkgutil.iter_modules(cellcrush.__path__):
        if not module.ispkg:
            tests.addTests(doctest.DocTestSuite(importlib.import_module(f"cellcrush.{module.name}")))
    return tests


class Page(WithServer):
    def test_every_block_of_the_page_runs(self):
        blocks = re.findall(r"```python\n(.*?)```", PAGE.read_text(), re.DOTALL)
        self.assertGreater(len(blocks), 5)
        self.addCleanup(os.chdir, os.getcwd())
        self.addCleanup(os.environ.pop, "CELLCRUSH_SERVER")
        os.chdir(self.folder)
        os.environ["CELLCRUSH_SERVER"] = self.server.address
        names: dict = {}
        for block in blocks:
            exec(compile(block, f"{PAGE.name}: {block.splitlines()[0]}", "exec"), names)
        for file in ("curves.pdf", "result.h5", "crush.pvd", "plateau.pdf", "crush.gif"):
            self.assertGreater((self.folder / file).stat().st_size, 100, file)


if __name__ == "__main__":
    unittest.main()
