"""airsim360.gym: spaces, episodes, seeds, one array for all. Works with and without gymnasium."""
import unittest

import numpy as np

import airsim360
import airsim360.gym as gym

ROOM = airsim360.World("box_room")
SMALL = dict(world=ROOM, width=64, seconds=2.0)


def towards_goal(state):
    """Velocity actions that fly straight to the goal."""
    goal = state[:, :3]
    length = np.maximum(1, np.linalg.norm(goal, axis=1, keepdims=True))
    return np.concatenate([0.6 * goal / length, np.zeros((len(state), 1))], 1).astype(np.float32)


class VectorEnvs(unittest.TestCase):
    def test_observations_are_in_their_spaces_and_in_one_array(self):
        env = gym.make_vec("reach", num_envs=3, seed=1, observations=["rgb", "range", "semantic", "entity"], **SMALL)
        seen, info = env.reset(seed=1)
        self.assertEqual(seen["rgb"].shape, (3, 32, 64, 3))
        self.assertEqual(seen["state"].shape, (3, 17))
        for _ in range(3):
            seen, rewards, terminated, truncated, info = env.step(env.action_space.sample())
            self.assertTrue(env.observation_space.contains(seen))
            self.assertEqual((rewards.shape, terminated.dtype, truncated.dtype), ((3,), np.bool_, np.bool_))
        # No copies: the views are those of the native arrays, before and after a step.
        self.assertTrue(np.shares_memory(seen["rgb"], env.native.rgb))
        before = seen["rgb"].copy()
        env.step(np.ones((3, 4), np.float32))
        self.assertTrue((seen["rgb"] != before).any())
        env.close()

    def test_copies_are_independent(self):
        env = gym.make_vec("reach", num_envs=2, seed=1, copy=True, **SMALL)
        seen, _ = env.reset(seed=1)
        before = seen["state"].copy()
        env.step(np.ones((2, 4), np.float32))
        np.testing.assert_array_equal(seen["state"], before)

    def test_the_same_seed_and_actions_give_the_same_bytes(self):
        def run(threads):
            with airsim360.Threads(threads):
                env = gym.make_vec("avoid", num_envs=3, **SMALL)
                seen, _ = env.reset(seed=9)
                random = np.random.default_rng(4)
                out = []
                for _ in range(25):
                    seen, rewards, *_ = env.step(random.uniform(-1, 1, (3, 4)))
                    out.append(b"".join(np.ascontiguousarray(a).tobytes() for a in (*seen.values(), rewards)))
                return out, env.native.hash()
        self.assertEqual(run(1), run(2))

    def test_reset_is_exact(self):
        env = gym.make_vec("search", num_envs=2, **SMALL)
        first = {name: a.copy() for name, a in env.reset(seed=3)[0].items()}
        env.step(np.ones((2, 4)))
        again, _ = env.reset(seed=3)
        for name, a in first.items():
            np.testing.assert_array_equal(a, again[name])
        other, _ = env.reset()
        self.assertFalse(np.array_equal(first["state"], other["state"]))

    def test_ended_episodes_begin_anew_in_the_next_step(self):
        env = gym.make_vec("reach", num_envs=4, seed=2, **SMALL)
        seen, _ = env.reset(seed=2)
        ended = np.zeros(4, bool)
        began = 0
        for _ in range(45):
            seen, rewards, terminated, truncated, info = env.step(towards_goal(seen["state"]))
            self.assertTrue((info["episode_step"][ended] == 0).all() and (rewards[ended] == 0).all())
            began += ended.sum()
            ended = terminated | truncated
            self.assertTrue((terminated == (info["success"] | info["crashed"])).all())
        self.assertGreater(began, 3)

    def test_bad_input_is_a_value_error(self):
        for options in (dict(task="raech"), dict(action="velocty"), dict(observations=["rgbd"]), dict(widht=64),
                        dict(period=0.0013), dict(num_envs=0), dict(task="search", target="no/such"),
                        dict(clearance="much"), dict(world="box_rom")):
            with self.subTest(options), self.assertRaises(ValueError):
                gym.VectorEnv(**{"world": ROOM, **options})
        env = gym.make_vec("reach", num_envs=2, **SMALL)
        for actions in (np.zeros((2, 3)), np.full((2, 4), np.nan)):
            with self.assertRaises(ValueError):
                env.step(actions)


class SingleEnvs(unittest.TestCase):
    def test_an_episode_runs_to_its_end_and_then_wants_a_reset(self):
        env = gym.make("reach", **SMALL)
        seen, info = env.reset(seed=5)
        self.assertTrue(env.observation_space.contains(seen))
        steps, done = 0, False
        while not done:
            seen, reward, terminated, truncated, info = env.step(towards_goal(seen["state"][None])[0])
            steps, done = steps + 1, terminated or truncated
        self.assertEqual(info["episode_step"], steps)
        with self.assertRaisesRegex(ValueError, "reset"):
            env.step(np.zeros(4))
        env.reset()
        env.step(np.zeros(4))
        self.assertEqual(env.render().shape, (32, 64, 3))

    def test_it_is_the_first_of_a_vector(self):
        one, many = gym.make("reach", **SMALL), gym.make_vec("reach", num_envs=3, **SMALL)
        a, b = one.reset(seed=8)[0], many.reset(seed=8)[0]
        for name in a:
            np.testing.assert_array_equal(a[name], b[name][0])

    @unittest.skipUnless(gym.HAS_GYMNASIUM, "gymnasium is not installed")
    def test_gymnasium_accepts_it(self):
        from gymnasium.utils.env_checker import check_env
        check_env(gym.make("reach", **SMALL), skip_render_check=True)


class ResetOptions(unittest.TestCase):
    def test_goal_start_and_yaw_are_those_asked_for(self):
        env = gym.make("reach", **SMALL)
        seen, info = env.reset(seed=1, options={"goal": [2, -3, 2], "start": [-2, 1, 1.5], "yaw": 0.5})
        pose = env.native.pose_of(0)
        np.testing.assert_allclose(pose[:3, 3], [-2, 1, 1.5])
        self.assertAlmostEqual(np.arctan2(pose[1, 0], pose[0, 0]), 0.5)
        np.testing.assert_allclose(env.native.goal_of(0), [2, -3, 2])
        self.assertAlmostEqual(info["distance"], np.linalg.norm([4, -4, 0.5]), places=5)
        # What was not asked for is as drawn; the next episode is drawn again.
        drawn, _ = env.reset(seed=1)
        start = env.native.pose_of(0)
        env.reset(seed=1, options={"goal": [2, -3, 2]})
        np.testing.assert_array_equal(env.native.pose_of(0), start)
        again, _ = env.reset(seed=1)
        np.testing.assert_array_equal(again["state"], drawn["state"])

    def test_a_row_an_environment_and_only_the_first_episodes(self):
        goals = np.array([[2, 2, 2], [-2, -2, 2], [0, 2, 3.0]])
        env = gym.make_vec("reach", num_envs=3, **SMALL)
        env.reset(seed=3, options={"goal": goals, "yaw": 1.0})
        np.testing.assert_array_equal([env.native.goal_of(i) for i in range(3)], goals)
        for _ in range(25):  # past the end of every episode (2 s)
            env.step(np.zeros((3, 4)))
        self.assertFalse(np.isclose([env.native.goal_of(i) for i in range(3)], goals).all(axis=1).any())

    def test_what_cannot_be_honoured_is_refused_and_changes_nothing(self):
        env, search = gym.make_vec("reach", num_envs=2, **SMALL), gym.make("search", **SMALL)
        env.reset(seed=4)
        before = env.native.hash()
        for options, said in (({"gaol": [0, 0, 2]}, "did you mean 'goal'"), ({"goal": [0, 0, 50000]}, "outside"),
                              ({"goal": [1e300, 0, 2]}, "goal: 1e\\+300 is not in"), ({"start": [4.99, 0, 2]}, "from a surface"),
                              ({"goal": [float("nan"), 0, 2]}, "goal"), ({"goal": "kitchen"}, "goal"),
                              ({"yaw": "north"}, "yaw"), ({"goal": np.zeros((3, 3))}, "3 rows for 2")):
            with self.subTest(options), self.assertRaisesRegex(ValueError, said):
                env.reset(seed=9, options=options)
            self.assertEqual(env.native.hash(), before)
        with self.assertRaisesRegex(ValueError, "target"):
            search.reset(options={"goal": [0, 0, 2]})

    def test_places_within_things_or_without_the_world_are_refused(self):
        env = gym.make("reach", **SMALL)
        for place, said in (([3, 0, .5], "inside of something"), ([50, 0, 1], "outside"), ([0, 0, -3], "outside")):
            for name in ("goal", "start"):
                with self.subTest(name, place=place), self.assertRaisesRegex(ValueError, f"{name}.*{said}"):
                    env.reset(options={name: place})

    def test_steps_belong_to_an_episode_and_closed_is_closed(self):
        for make, zeros in ((gym.make, np.zeros(4)), (lambda *a, **o: gym.make_vec(*a, num_envs=1, **o), np.zeros((1, 4)))):
            env = make("reach", **SMALL)
            with self.assertRaisesRegex(ValueError, "reset first"):
                env.step(zeros)
            env.reset()
            env.step(zeros)
            env.close()
            for call in (env.reset, lambda: env.step(zeros)):
                with self.assertRaisesRegex(ValueError, "closed"):
                    call()

    def test_what_would_be_ignored_is_refused(self):
        with self.assertRaisesRegex(ValueError, "target.*did you mean task 'search'"):
            gym.make("reach", target="furniture", **SMALL)
        with self.assertRaisesRegex(ValueError, "'rgb' needs light"):
            gym.make("reach", **{**SMALL, "observations": ["rgb"], "tier": "labels"})
        dark = gym.make("reach", **{**SMALL, "observations": None, "tier": "labels"})
        self.assertEqual(set(dark.observation_space.spaces), {"range", "state"})

    def test_a_typing_error_in_an_option_names_it(self):
        with self.assertRaisesRegex(ValueError, "did you mean 'width'"):
            gym.make("reach", world=ROOM, wdith=64)

    def test_what_wrappers_use_is_there(self):
        env = gym.make("reach", **SMALL)
        env.reset(seed=3)
        first = env.np_random.integers(1 << 30)
        env.reset(seed=3)
        self.assertEqual(env.np_random.integers(1 << 30), first)
        self.assertTrue(env.has_wrapper_attr("native") and not env.has_wrapper_attr("no_such"))
        env.set_wrapper_attr("note", 5)
        self.assertEqual(env.get_wrapper_attr("note"), 5)


class Spaces(unittest.TestCase):
    def test_boxes_sample_within_their_bounds(self):
        box = gym.Box(np.array([-1, 0], np.float32), np.array([1, np.inf], np.float32), dtype=np.float32)
        box.seed(1)
        for _ in range(100):
            self.assertTrue(box.contains(box.sample()))
        self.assertFalse(box.contains(np.array([2, 0], np.float32)))
        self.assertFalse(box.contains(np.zeros(3, np.float32)))
        pixels = gym.Box(0, 255, (4, 4), np.uint8)
        draws = np.array([pixels.sample() for _ in range(200)])
        self.assertEqual((draws.min(), draws.max()), (0, 255))


if __name__ == "__main__":
    unittest.main()
