"""A daemon with TLS, tokens and client certificates."""
import os
import pathlib
import subprocess
import tempfile
import unittest
import unittest.mock

import cellcrush as cc


class Access(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(dir="/tmp")))
        for name, usage in (("server", "serverAuth"), ("ben", "clientAuth")):
            subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1",
                            "-nodes", "-keyout", f"{name}-key.pem", "-out", f"{name}.pem", "-days", "2", "-subj",
                            f"/CN={name}", "-addext", "subjectAltName=DNS:localhost", "-addext",
                            f"extendedKeyUsage={usage}"], cwd=self.folder, check=True, capture_output=True)

    def start(self, *options):
        daemon = subprocess.Popen([os.environ["CELLCRUSHD"], "--data", "data", "--listen", "localhost:0", "--http",
                                   "none", "--tls-cert", "server.pem", "--tls-key", "server-key.pem", *options],
                                  cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.addCleanup(daemon.wait)
        self.addCleanup(daemon.terminate)
        with daemon.stdout as said:
            port = said.readline().split()[-1].rpartition(":")[-1]
        return f"localhost:{port}"

    def test_a_token_opens_a_daemon_with_tls(self):
        made = subprocess.run([os.environ["CELLCRUSHD"], "token", "ada", "--scope", "submit"], check=True, text=True,
                              capture_output=True).stdout.splitlines()
        (self.folder / "token").write_text(made[0] + "\n")
        (self.folder / "tokens").write_text(made[1] + "\n")
        (self.folder / "tokens").chmod(0o600)
        address, ca = self.start("--tokens", "tokens"), str(self.folder / "server.pem")
        with cc.connect(address, ca=ca, token_file=str(self.folder / "token")) as server:
            self.assertIn("preset:type-i", server.presets())
        with cc.connect(address, ca=ca) as server, self.assertRaisesRegex(cc.CrushError, "UNAUTHENTICATED"):
            server.presets()

    def test_a_certificate_opens_a_daemon(self):
        address, ca = self.start("--tls-client-ca", "ben.pem"), str(self.folder / "server.pem")
        names = {"certificate": str(self.folder / "ben.pem"), "key": str(self.folder / "ben-key.pem")}
        with cc.connect(address, ca=ca, **names) as server:
            self.assertIn("preset:type-i", server.presets())
        with self.assertRaisesRegex(ValueError, "go together"):
            cc.connect(address, ca=ca, certificate=names["certificate"])

    def test_another_users_daemon_is_changed_only_if_it_is_named(self):
        daemon = subprocess.Popen([os.environ["CELLCRUSHD"], "--data", "data", "--listen", "127.0.0.1:0", "--http",
                                   "none"], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                                  text=True)
        self.addCleanup(daemon.wait)
        self.addCleanup(daemon.terminate)
        with daemon.stdout as said:
            address = said.readline().split()[-1]
        place = "cellcrush.connection."
        self.enterContext(unittest.mock.patch.dict(os.environ, {"XDG_DATA_HOME": str(self.folder)}))
        self.enterContext(unittest.mock.patch(place + "DEFAULT_ADDRESS", address))
        with cc.connect() as server:
            server.submit("preset:hexagon-small")
        self.enterContext(unittest.mock.patch(place + "_own_user", lambda: "someone"))
        with cc.connect() as server:
            self.assertEqual(len(list(server.jobs())), 1)
            with self.assertRaisesRegex(cc.CrushError, "changed only if you name it"):
                server.submit("preset:hexagon-small")


if __name__ == "__main__":
    unittest.main()
