"""The package for asyncio: the same calls, and that they work."""
import asyncio
import inspect
import unittest

import cellcrush as cc
import cellcrush.aio
from support import PRESET, SLOW, SMALL, WithServer

NAMED_OTHERWISE = {"__iter__": "__aiter__", "__enter__": "__aenter__", "__exit__": "__aexit__"}


def calls_of(kind):
    """The names of a class that a caller uses, with what they are."""
    names = {name for name in dir(kind) if not name.startswith("_")} | {
        name for name in (*NAMED_OTHERWISE, "__len__", "_repr_html_") if hasattr(kind, name)}
    return {name: inspect.getattr_static(kind, name) for name in names}


class Mirror(unittest.TestCase):
    def test_every_call_of_the_package_is_here(self):
        self.assertEqual(set(cellcrush.aio.__all__), set(cc.__all__))
        for name in cc.__all__:
            plain, mirror = getattr(cc, name), getattr(cellcrush.aio, name)
            if inspect.isfunction(plain):
                self.assertFalse(mirror is plain, name)
                self.compare(plain, mirror, name)
            elif mirror is not plain:
                for member, found in calls_of(plain).items():
                    here = NAMED_OTHERWISE.get(member, member)
                    self.assertTrue(hasattr(mirror, here), f"{name}.{here}")
                    self.compare(found, inspect.getattr_static(mirror, here), f"{name}.{member}")

    def compare(self, plain, mirror, name):
        if not inspect.isfunction(plain):
            return
        plain, mirror = (list(inspect.signature(call).parameters.values()) for call in (plain, mirror))
        if mirror[-1].kind is inspect.Parameter.VAR_KEYWORD:  # passes on the rest
            plain, mirror = plain[:len(mirror) - 1], mirror[:-1]
        self.assertEqual([(of.name, of.kind) for of in mirror], [(of.name, of.kind) for of in plain], name)

    def test_what_waits_can_be_awaited(self):
        for name in ("Server", "Job", "Sweep"):
            for member, found in calls_of(getattr(cellcrush.aio, name)).items():
                if inspect.isfunction(found) and not member.startswith("_"):
                    self.assertTrue(inspect.iscoroutinefunction(found) or inspect.isasyncgenfunction(found), member)
                    self.assertTrue(found.__doc__ or not calls_of(getattr(cc, name))[member].__doc__, member)


class Asyncio(WithServer):
    def test_asyncio_waits_for_many_jobs(self):
        async def crush():
            server = await cellcrush.aio.connect(self.server.address)
            jobs = [await server.submit(PRESET, SMALL, speed_m_per_s=speed) for speed in (100, 200)]
            await asyncio.gather(*(job.wait() for job in jobs))
            return [(job.state, len(await job.samples())) for job in jobs]

        for state, count in asyncio.run(crush()):
            self.assertEqual(state, "SUCCEEDED")
            self.assertGreater(count, 100)

    def test_asyncio_has_sweeps_and_watches(self):
        async def crush():
            server = await cellcrush.aio.connect(self.server.address)
            self.assertEqual((await server.check(PRESET, SMALL)).problems, [])
            sweep = await (await server.sweep(PRESET, SMALL, speed_m_per_s=[100, 200])).wait()
            job = (await sweep.jobs())[0]
            self.assertIn(job.name, [other.name for other in await server.jobs("state = SUCCEEDED")])
            strains = [sample.strain async for sample in job.watch()]
            self.assertEqual(strains, list((await job.history())["strain"]))
            self.assertGreater(len(await job.frames()), 5)
            states = list((await sweep.table())["state"])
            await sweep.delete()
            slow = await server.submit(PRESET, SLOW)
            with self.assertRaises(cc.JobFailed):
                await (await slow.cancel()).wait()
            await slow.delete()
            return states

        self.assertEqual(asyncio.run(crush()), ["SUCCEEDED"] * 2)

    def test_asyncio_draws_and_saves(self):
        async def crush():
            async with cellcrush.aio.private_server() as server:
                self.assertIn(PRESET, await server.presets())
                job = await server.submit(PRESET, SMALL)
                ax = await job.live_plot()
                self.assertEqual(ax.get_ylabel(), (await job.plot()).get_ylabel())
                self.assertEqual((await server.get(job.name)).name, job.name)
                self.assertEqual((await job.case()).loading.speed_m_per_s, 100)
                sweep = await (await server.sweep(PRESET, SMALL, speed_m_per_s=[100, 200])).wait()
                self.assertEqual((await sweep.plot()).get_xlabel(), "speed (m/s)")
                self.assertEqual([job.state async for job in await server.get(sweep.name)], ["SUCCEEDED"] * 2)
                await job.write_vtk(self.folder / "crush.pvd")
                return (await cellcrush.aio.open(await job.download(self.folder / "result.h5"))).title, job.title

        self.assertEqual(*asyncio.run(crush()))

    def test_run_needs_no_daemon(self):
        with self.assertRaisesRegex(cc.JobFailed, "result.h5 has the results so far"):
            asyncio.run(cellcrush.aio.run(PRESET, SLOW, time_limit_s=1, output=self.folder / "result.h5"))
        job = asyncio.run(cellcrush.aio.run(PRESET, SMALL))
        self.assertGreater(len(asyncio.run(job.frames())), 5)

    def test_a_cancelled_wait_leaves_the_job_running(self):
        async def crush():
            job = await cellcrush.aio.Server(self.server).submit(PRESET, SLOW)
            with self.assertRaises(asyncio.TimeoutError):
                await asyncio.wait_for(job.wait(), 0.5)
            state = (await job.refresh()).state
            await job.cancel()
            return state

        self.assertIn(asyncio.run(crush()), ("PENDING", "RUNNING"))


if __name__ == "__main__":
    unittest.main()
