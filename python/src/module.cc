// airsim360._native: the C++ library as Python sees it. Names and shapes: docs/reference/python.md.
#include <memory>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "convert.h"

namespace airsim360::python {
namespace {

/// `with airsim360.Threads(1): ...`
class Threads {
 public:
  explicit Threads(int threads) : threads_(threads) {
    if (threads < 0) throw InputError("Threads: " + std::to_string(threads) + "; give 0 (all) or more");
  }
  void Enter() { limit_ = std::make_unique<ThreadLimit>(threads_); }
  void Exit() { limit_.reset(); }

 private:
  int threads_;
  std::unique_ptr<ThreadLimit> limit_;
};

}  // namespace
}  // namespace airsim360::python

PYBIND11_MODULE(_native, m) {
  using namespace airsim360;
  using namespace airsim360::python;
  m.doc() = "AirSim360's C++ library. W is east-north-up, B forward-left-up; metres, seconds, radians.";
  py::register_exception_translator([](std::exception_ptr error) {
    try {
      if (error) std::rethrow_exception(error);
    } catch (const InputError& e) {
      PyErr_SetString(PyExc_ValueError, e.what());
    } catch (const RuntimeError& e) {
      PyErr_SetString(PyExc_RuntimeError, e.what());
    }
  });
  py::class_<Threads>(m, "Threads", "Limits every parallel loop of the process to `threads` (0 = all cores) in a with block.")
      .def(py::init<int>(), py::arg("threads"))
      .def("__enter__", [](Threads& t) { t.Enter(); })
      .def("__exit__", [](Threads& t, const py::args&) { t.Exit(); });
  m.def("thread_count", &ThreadCount, "Number of threads that parallel loops use now.");
  BindTensor(m);
  BindCapture(m);
  BindLidar(m);
  BindWorld(m);
  BindDrone(m);
  BindPlanning(m);
  BindState(m);
  BindSimulation(m);
  BindMetrics(m);
  BindVideo(m);
  BindGeodesy(m);
  BindPictures(m);
  BindVectorEnvironment(m);
  BindPlanFrames(m);
}
