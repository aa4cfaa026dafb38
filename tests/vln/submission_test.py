"""A submission holds what it says, and whoever changes it is found out."""
import json
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

from vln_tools import lines, make_room, run


class Submission(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.path = Path(cls.folder.name)
        cls.episodes = make_room(cls.path, 3)
        cls.results, cls.packed = cls.path / "results.jsonl", cls.path / "packed.json"
        run("vln", "run", cls.episodes, "--agent", "mask", "--out", cls.results)
        run("vln", "submit", cls.episodes, cls.results, "--name", "mask", "--out", cls.packed)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def changed(self, change):
        packed = json.loads(self.packed.read_text(encoding="utf-8"))
        change(packed)
        file = self.path / "changed.json"
        file.write_text(json.dumps(packed), encoding="utf-8")
        return run("vln", "verify", file, self.episodes, status=1).stdout

    def test_what_was_packed_holds_scored_and_flown_again(self):
        self.assertIn("all holds", run("vln", "verify", self.packed, self.episodes).stdout)
        self.assertIn("all holds", run("vln", "verify", self.packed, self.episodes, "--fly").stdout)

    def test_changes_are_found(self):
        def better(p): p["scores"]["spl"] = 0.999
        def nearer(p): p["results"][0]["distance"] = 0
        def fewer(p): p["results"].pop()
        def moved(p): p["results"][0]["pred"][-1] = [9, 9, 9]
        def unknown(p): p["results"][0]["id"] = "other"
        for change, says in ((better, "score spl"), (nearer, "distance"), (fewer, "leave some out"), (moved, "path"), (unknown, "no episode")):
            text = self.changed(change)
            self.assertIn("seal", text, change.__name__)
            self.assertIn(says, text, change.__name__)

    @unittest.skipUnless(shutil.which("openssl"), "needs openssl to make keys")
    def test_keys_tell_who_packed_it(self):
        public = {}
        for name in ("mine", "theirs"):
            key = self.path / f"{name}.pem"
            subprocess.run(["openssl", "genpkey", "-algorithm", "ed25519", "-out", str(key)], check=True, capture_output=True)
            # The last 32 bytes of the DER of a public key are the key (RFC 8410).
            der = subprocess.run(["openssl", "pkey", "-in", str(key), "-pubout", "-outform", "DER"], check=True, capture_output=True).stdout
            public[name] = der[-32:].hex()
        signed = self.path / "signed.json"
        run("vln", "submit", self.episodes, self.results, "--key", self.path / "mine.pem", "--out", signed)
        packed = json.loads(signed.read_text(encoding="utf-8"))
        self.assertEqual(packed["public_key"], public["mine"])
        self.assertIn("all holds", run("vln", "verify", signed, self.episodes, "--signer", public["mine"]).stdout)
        self.assertIn("sign", run("vln", "verify", signed, self.episodes, "--signer", public["theirs"], status=1).stdout)
        self.assertIn("sign", run("vln", "verify", self.packed, self.episodes, "--signer", public["mine"], status=1).stdout)
        for name, value in (("signature", packed["signature"][:-2] + ("00" if packed["signature"][-2:] != "00" else "11")), ("public_key", public["theirs"])):
            file = self.path / "forged.json"
            file.write_text(json.dumps({**packed, name: value}), encoding="utf-8")
            self.assertNotIn("all holds", run("vln", "verify", file, self.episodes, status=1).stdout, name)
        no_key = self.path / "no_key.pem"
        no_key.write_text("-----BEGIN PRIVATE KEY-----\nAAAA\n-----END PRIVATE KEY-----\n")
        self.assertIn("--key", run("vln", "submit", self.episodes, self.results, "--key", no_key, "--out", self.path / "none.json", status=2).stderr)
        self.assertFalse((self.path / "none.json").exists())

    def test_other_episodes_are_not_those_of_the_submission(self):
        other = self.path / "other.jsonl"
        other.write_text("".join(json.dumps(e) + "\n" for e in lines(self.episodes)), encoding="utf-8")
        self.assertIn("not those of the submission", run("vln", "verify", self.packed, other, status=1).stdout)

    def test_what_is_no_submission_is_refused(self):
        self.assertIn("results.jsonl", run("vln", "verify", self.results, self.episodes, status=2).stderr)


if __name__ == "__main__":
    unittest.main()
