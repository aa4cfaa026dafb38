#include "airsim360/mpde/matrix/gemm.h"

namespace airsim360::internal::AIRSIM360_ISA {
namespace {

// As many rows at once as leave their sums in registers.
#if defined(__AVX512F__)
constexpr int kRows = 12;
#elif defined(__AVX2__)
constexpr int kRows = 6;
#else
constexpr int kRows = 3;
#endif

using Lanes [[gnu::vector_size(64), gnu::may_alias]] = float;

template <int rows>
[[gnu::always_inline]] inline void RowsTimesPanel(const float* a, const float* panel, float* c, int k, int64_t ldc, int columns) {
  Lanes sums[rows] = {};
  for (int p = 0; p < k; ++p) {
    const Lanes b = *reinterpret_cast<const Lanes*>(panel + static_cast<int64_t>(p) * 16);
    for (int i = 0; i < rows; ++i) sums[i] += a[static_cast<int64_t>(i) * k + p] * b;
  }
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) c[i * ldc + j] = sums[i][j];
  }
}

}  // namespace

void MultiplyPanel(const float* a, const float* panel, float* c, int m, int k, int64_t ldc, int columns) {
  int row = 0;
  for (; row + kRows <= m; row += kRows) RowsTimesPanel<kRows>(a + static_cast<int64_t>(row) * k, panel, c + row * ldc, k, ldc, columns);
  for (; row < m; ++row) RowsTimesPanel<1>(a + static_cast<int64_t>(row) * k, panel, c + row * ldc, k, ldc, columns);
}

}  // namespace airsim360::internal::AIRSIM360_ISA
