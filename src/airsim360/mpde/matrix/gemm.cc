#include "airsim360/mpde/matrix/gemm.h"

#include <algorithm>
#include <new>
#include <vector>

#include "airsim360/base/parallel.h"

namespace airsim360 {
namespace {

struct alignas(64) PanelRow {
  float value[kPanelColumns] = {};
};

// Columns [first, first + columns) of B, one row of 16 after the other, filled up with zeros.
void Pack(const float* b, int k, int n, bool b_transposed, int first, int columns, std::vector<PanelRow>& panel) {
  panel.assign(static_cast<size_t>(k), {});
  for (int p = 0; p < k; ++p) {
    for (int j = 0; j < columns; ++j) {
      const int64_t column = first + j;
      panel[static_cast<size_t>(p)].value[j] = b_transposed ? b[column * k + p] : b[static_cast<int64_t>(p) * n + column];
    }
  }
}

}  // namespace

template <>
void Multiply<float>(const float* a, const float* b, float* c, int m, int k, int n, bool b_transposed) {
  const auto kernel = AIRSIM360_SELECT_KERNEL(MultiplyPanel);
  ParallelFor((n + kPanelColumns - 1) / kPanelColumns, [&](int64_t i) {
    thread_local std::vector<PanelRow> panel;
    const int first = static_cast<int>(i) * kPanelColumns, columns = std::min(kPanelColumns, n - first);
    Pack(b, k, n, b_transposed, first, columns, panel);
    kernel(a, panel.data()->value, c + first, m, k, n, columns);
  });
}

template <>
void Multiply<double>(const double* a, const double* b, double* c, int m, int k, int n, bool b_transposed) {
  for (int64_t i = 0; i < m; ++i) {
    for (int64_t j = 0; j < n; ++j) {
      double sum = 0;
      for (int64_t p = 0; p < k; ++p) sum += a[i * k + p] * (b_transposed ? b[j * k + p] : b[p * n + j]);
      c[i * n + j] = sum;
    }
  }
}

template <class Real>
void Transpose(const Real* from, Real* to, int rows, int columns) {
  // In strips that stay in the cache.
  constexpr int64_t kStrip = 16;
  for (int64_t first = 0; first < rows; first += kStrip) {
    const int64_t end = std::min<int64_t>(rows, first + kStrip);
    for (int64_t j = 0; j < columns; ++j) {
      for (int64_t i = first; i < end; ++i) to[j * rows + i] = from[i * columns + j];
    }
  }
}
template void Transpose<float>(const float*, float*, int, int);
template void Transpose<double>(const double*, double*, int, int);

}  // namespace airsim360
