"""DLPack of pictures in memory of a (pretended) CUDA device, read as a consumer written in C would."""
import ctypes
import gc
import os
import unittest

import numpy as np

import airsim360
from airsim360 import Rig, Simulation, World

RIG = Rig(width=64, products=["rgb", "range", "semantic", "entity", "normal"], tier="fast")


class DLTensor(ctypes.Structure):
    _fields_ = [("data", ctypes.c_void_p), ("device_type", ctypes.c_int32), ("device_id", ctypes.c_int32), ("ndim", ctypes.c_int32),
                ("code", ctypes.c_uint8), ("bits", ctypes.c_uint8), ("lanes", ctypes.c_uint16), ("shape", ctypes.POINTER(ctypes.c_int64)),
                ("strides", ctypes.POINTER(ctypes.c_int64)), ("byte_offset", ctypes.c_uint64)]


class Managed(ctypes.Structure):
    _fields_ = [("tensor", DLTensor), ("context", ctypes.c_void_p), ("deleter", ctypes.CFUNCTYPE(None, ctypes.c_void_p))]


class Versioned(ctypes.Structure):
    _fields_ = [("major", ctypes.c_uint32), ("minor", ctypes.c_uint32), ("context", ctypes.c_void_p),
                ("deleter", ctypes.CFUNCTYPE(None, ctypes.c_void_p)), ("flags", ctypes.c_uint64), ("tensor", DLTensor)]


api = ctypes.pythonapi
api.PyCapsule_GetPointer.restype, api.PyCapsule_GetPointer.argtypes = ctypes.c_void_p, [ctypes.py_object, ctypes.c_char_p]
api.PyCapsule_SetName.argtypes = [ctypes.py_object, ctypes.c_char_p]


class Consumer:
    """Takes a capsule over, as from_dlpack of a GPU library does."""

    def __init__(self, capsule, versioned=False):
        self.name = b"dltensor_versioned" if versioned else b"dltensor"
        self.address = api.PyCapsule_GetPointer(capsule, self.name)
        self.used = b"used_" + self.name  # the capsule keeps a pointer to the text
        api.PyCapsule_SetName(capsule, self.used)
        self.capsule = capsule
        self.managed = (Versioned if versioned else Managed).from_address(self.address)

    def array(self):
        t = self.managed.tensor
        kind = {0: "i", 1: "u", 2: "f"}[t.code] + str(t.bits // 8)
        shape, strides = [t.shape[i] for i in range(t.ndim)], [t.strides[i] * t.bits // 8 for i in range(t.ndim)]
        size = (shape[0] - 1) * strides[0] + shape[1] * strides[1]
        buffer = (ctypes.c_uint8 * size).from_address(t.data)
        return np.ndarray(shape, kind, buffer, 0, strides)

    def drop(self):
        self.managed.deleter(self.address)


def software_gpu():
    for gpu in airsim360.gpus():
        if gpu["software"] and not gpu["missing"]:
            return gpu
    return None


class CudaTensors(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        gpu = software_gpu()
        if gpu is None:
            raise unittest.SkipTest("no lavapipe that traces rays (apt-get install -t bookworm-backports mesa-vulkan-drivers)")
        cls.fake = ctypes.CDLL(os.environ["AIRSIM360_LIBCUDA"])
        cls.fake.fake_cuda_calls.restype = ctypes.c_char_p
        cls.fake.fake_cuda_set_header.argtypes = [ctypes.c_ulonglong]
        cls.fake.fake_cuda_set_uuid(1, gpu["uuid"])
        cls.world = World("box_room", device="vulkan", gpu=gpu["index"])
        cls.sim = Simulation(cls.world)
        cls.expected = cls.sim.capture(RIG)
        # lavapipe's shared memory begins behind bytes of its own.
        first = Consumer(cls.sim.capture(RIG, memory="cuda").tensor("range").__dlpack__())
        begin = first.managed.tensor.data
        wanted = cls.expected.range.tobytes()[:1024]
        cls.header = next(at for at in range(0, 65536, 16) if ctypes.string_at(begin + at, 1024) == wanted)
        first.drop()

    def setUp(self):
        self.fake.fake_cuda_set_header(self.header)
        self.sim = Simulation(self.world)
        self.fake.fake_cuda_forget()

    def calls(self):
        return self.fake.fake_cuda_calls().decode()

    def test_every_picture_is_that_of_the_vulkan_renderer(self):
        capture = self.sim.capture(RIG, memory="cuda")
        self.assertIsInstance(capture, airsim360.CudaCapture)
        with self.assertRaisesRegex(ValueError, "rgb"):
            capture.rgb
        np.testing.assert_array_equal(capture.pose, self.expected.pose)
        for name in ("rgb", "range", "semantic", "entity", "normal"):
            tensor = capture.tensor(name)
            wanted = getattr(self.expected, name)
            self.assertEqual(tensor.__dlpack_device__(), (2, 1), name)
            self.assertEqual(tensor.shape, wanted.shape)
            taken = Consumer(tensor.__dlpack__(stream=1))
            self.assertEqual((taken.managed.tensor.device_type, taken.managed.tensor.device_id), (2, 1))
            self.assertEqual(taken.array().dtype, wanted.dtype)
            np.testing.assert_array_equal(taken.array(), wanted, name)
            taken.drop()

    def test_versioned_capsules_are_given_to_those_who_know_them(self):
        tensor = self.sim.capture(RIG, memory="cuda").tensor("range")
        new = Consumer(tensor.__dlpack__(max_version=(1, 0)), versioned=True)
        self.assertEqual((new.managed.major, new.managed.minor, new.managed.flags), (1, 0, 0))
        np.testing.assert_array_equal(new.array(), self.expected.range)
        copied = Consumer(tensor.__dlpack__(max_version=(1, 1), copy=True), versioned=True)
        self.assertEqual(copied.managed.flags, 2)
        self.assertNotEqual(copied.managed.tensor.data, new.managed.tensor.data)
        np.testing.assert_array_equal(copied.array(), self.expected.range)
        old = Consumer(tensor.__dlpack__(max_version=(0, 8)))
        for taken in (new, copied, old):
            taken.drop()

    def test_memory_lives_as_long_as_anybody_holds_it(self):
        capture = self.sim.capture(RIG, memory="cuda")
        taken = Consumer(capture.tensor("range").__dlpack__())
        unused = capture.tensor("entity").__dlpack__()
        del capture, unused
        self.sim = None
        gc.collect()
        np.testing.assert_array_equal(taken.array(), self.expected.range)
        self.assertNotIn("cuDestroyExternalMemory", self.calls())
        taken.drop()
        self.assertIn("cuMemFree_v2\ncuDestroyExternalMemory\ncuDevicePrimaryCtxRelease_v2 101\n", self.calls())
        self.assertNotIn("error:", self.calls())

    def test_a_held_picture_is_not_overwritten(self):
        taken = Consumer(self.sim.capture(RIG, memory="cuda").tensor("range").__dlpack__())
        self.sim.takeoff(height=1.5)
        self.sim.run(3)
        later = Consumer(self.sim.capture(RIG, memory="cuda").tensor("range").__dlpack__())
        np.testing.assert_array_equal(taken.array(), self.expected.range)
        self.assertFalse(np.array_equal(later.array(), taken.array()))
        taken.drop()
        later.drop()

    def test_streams_follow_the_protocol(self):
        tensor = self.sim.capture(RIG, memory="cuda").tensor("range")
        for stream in (None, -1, 1, 2, 4711):
            Consumer(tensor.__dlpack__(stream=stream)).drop()
        for stream in (0, -2):
            with self.assertRaisesRegex(ValueError, "stream"):
                tensor.__dlpack__(stream=stream)
        self.fake.fake_cuda_forget()
        for stream, asked in ((None, 1), (-1, 1), (2, 2), (4711, 4711)):
            Consumer(tensor.__dlpack__(stream=stream, copy=True)).drop()
            self.assertIn(f"stream {asked}\n", self.calls())

    def test_pictures_come_to_the_cpu_when_asked(self):
        tensor = self.sim.capture(RIG, memory="cuda").tensor("rgb")
        taken = Consumer(tensor.__dlpack__(dl_device=(1, 0), max_version=(1, 0)), versioned=True)
        self.assertEqual((taken.managed.tensor.device_type, taken.managed.flags), (1, 2))
        np.testing.assert_array_equal(taken.array(), self.expected.rgb)
        taken.drop()
        Consumer(tensor.__dlpack__(dl_device=(2, 1))).drop()
        for refused in ({"dl_device": (1, 0), "copy": False}, {"dl_device": (2, 0)}, {"dl_device": (10, 0)}):
            with self.assertRaises(BufferError):
                tensor.__dlpack__(**refused)

    def test_what_cannot_be_is_said(self):
        with self.assertRaisesRegex(ValueError, "device=\"vulkan\""):
            Simulation(World("box_room", device="cpu")).capture(RIG, memory="cuda")
        with self.assertRaisesRegex(ValueError, "did you mean 'cuda'"):
            self.sim.capture(RIG, memory="cude")
        with self.assertRaisesRegex(ValueError, "not captured"):
            self.sim.capture(RIG, memory="cuda").tensor("flow")
        library = os.environ["AIRSIM360_LIBCUDA"]
        os.environ["AIRSIM360_LIBCUDA"] = "/nowhere/libcuda.so.1"
        try:
            with self.assertRaisesRegex(RuntimeError, "CUDA: no driver"):
                Simulation(self.world).capture(RIG, memory="cuda")
        finally:
            os.environ["AIRSIM360_LIBCUDA"] = library


if __name__ == "__main__":
    unittest.main()
