"""`dataset slurm --backend kubernetes`: the manifest is valid by the schemas that Kubernetes publishes (npm package kubernetes-models;
skipped where npm cannot get it), every key of it is known to them, and what its container runs makes the dataset."""
import json
import os
import pathlib
import subprocess
import sys
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "end_to_end"))
sys.path.insert(0, str(HERE.parent / "formats"))
from program import PROGRAM, ProgramTest, tree  # noqa: E402
from readers import npm_folder  # noqa: E402

RECIPE = """
name: A very long name of a dataset that no cluster would take as it is
picture: {size: 64x32, tier: labels}
rows:
  - {name: boxes, world: box_room, frames: 6, clearance: 0.5, highest: 5}
"""

# Validates every document; then puts a value of the wrong kind at every place: a schema that knows the key refuses it.
CHECK = """
import fs from 'fs';
import { loadAll } from 'js-yaml';
import { Job } from 'kubernetes-models/batch/v1';
import { ConfigMap } from 'kubernetes-models/v1';
const kinds = {Job, ConfigMap};
const documents = loadAll(fs.readFileSync(process.argv[2], 'utf8'));
const valid = document => { try { new kinds[document.kind](document).validate(); return null; } catch (e) { return e.message; } };
const unknown = [];
function spoil(document, place, path) {
  for (const key of Object.keys(place)) {
    const value = place[key], here = path + '/' + key;
    if (here !== '/kind' && here !== '/apiVersion') {
      place[key] = Array.isArray(value) ? {x: 1} : [['x']];
      if (valid(document) === null) unknown.push(here);
      place[key] = value;
    }
    if (value !== null && typeof value === 'object') spoil(document, value, here);
  }
}
const told = documents.map(valid);
documents.forEach(d => spoil(d, d, ''));
console.log(JSON.stringify({documents, told, unknown}));
"""


class Kubernetes(ProgramTest):
    def plan(self):
        (self.folder / "recipe.yaml").write_text(RECIPE)
        self.run_ok("dataset", "plan", self.folder / "recipe.yaml", "--out", self.folder / "plan.json")
        return self.folder / "plan.json"

    def manifest(self, *flags):
        file = self.folder / "job.yaml"
        self.run_ok("dataset", "slurm", self.folder / "plan.json", "--backend", "kubernetes", *flags, "--out", file)
        folder = npm_folder("kubernetes-models") and npm_folder("js-yaml")
        if folder is None:
            self.skipTest("npm cannot get kubernetes-models here")
        (folder / "kubernetes.mjs").write_text(CHECK)
        result = subprocess.run(["node", str(folder / "kubernetes.mjs"), str(file)], capture_output=True, text=True, timeout=120)
        self.assertEqual(result.returncode, 0, result.stderr)
        report = json.loads(result.stdout)
        self.assertEqual((report["told"], report["unknown"]), ([None] * len(report["documents"]), []))
        return report["documents"]

    def test_the_manifest_is_valid_and_its_container_makes_the_dataset(self):
        plan = self.plan()
        parts, job = self.manifest("--array", "3", "--cpus", "1", "--program", PROGRAM)
        self.assertEqual(parts["data"]["plan.json"], plan.read_text())
        spec, pod = job["spec"], job["spec"]["template"]["spec"]
        self.assertEqual((spec["completions"], spec["parallelism"], spec["completionMode"], spec["backoffLimitPerIndex"]), (3, 3, "Indexed", 2))
        # The names of pods are that of the job and an index: 63 letters at most.
        self.assertLessEqual(len(job["metadata"]["name"] + "-999999"), 63)
        self.assertRegex(job["metadata"]["name"], r"^[a-z0-9]([-a-z0-9]*[a-z0-9])?$")
        self.assertEqual({m["name"]: m["mountPath"] for m in pod["containers"][0]["volumeMounts"]}, {"data": "/data", "plan": "/plan"})
        self.assertEqual({v["name"] for v in pod["volumes"]}, {"data", "plan"})
        # As the pods would, with their paths on this machine.
        [container] = pod["containers"]
        script = container["args"][0].replace("/plan/plan.json", str(plan)).replace("/data/plan_shards", str(self.folder / "shards"))
        for index in range(3):
            done = subprocess.run([*container["command"], script], env={**os.environ, "JOB_COMPLETION_INDEX": str(index)}, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
        self.run_ok("dataset", "merge", *sorted((self.folder / "shards").iterdir()), "--out", self.folder / "merged")
        self.run_ok("dataset", "run", plan, "--out", self.folder / "whole")
        self.assertEqual(tree(self.folder / "merged"), tree(self.folder / "whole"))

    def test_an_object_store_takes_the_place_of_the_volume(self):
        self.plan()
        _, job = self.manifest("--array", "2", "--remote", "store:bucket/set", "--secret", "rclone")
        pod = job["spec"]["template"]["spec"]
        self.assertEqual([v for v in pod["volumes"] if v["name"] == "data"], [{"name": "data", "emptyDir": {}}])
        self.assertEqual(pod["containers"][0]["envFrom"], [{"secretRef": {"name": "rclone"}}])
        self.assertIn("REMOTE='store:bucket/set'", pod["containers"][0]["args"][0])
        _, job = self.manifest("--array", "2", "--remote", "store:bucket/set", "--claim", "fast", "--at-once", "1", "--image", 'reg/"x":1')
        pod = job["spec"]["template"]["spec"]
        self.assertEqual([v for v in pod["volumes"] if v["name"] == "data"], [{"name": "data", "persistentVolumeClaim": {"claimName": "fast"}}])
        self.assertEqual((job["spec"]["parallelism"], pod["containers"][0]["image"]), (1, 'reg/"x":1'))


if __name__ == "__main__":
    unittest.main()
