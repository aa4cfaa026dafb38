// Matrix products whose elements are sums in a fixed order: any number of threads and any instruction set give the same bits.
#pragma once

#include <cstdint>

#include "airsim360/base/kernel_isa.h"

namespace airsim360 {

/// Columns of a packed panel (gemm_kernel.cc).
inline constexpr int kPanelColumns = 16;

/// C = A B: A is m x k, C is m x n, both by rows without gaps; B is k x n, or n x k if `b_transposed`. Nothing may overlap.
template <class Real>
void Multiply(const Real* a, const Real* b, Real* c, int m, int k, int n, bool b_transposed = false);

/// `to` (columns x rows) becomes the transpose of `from` (rows x columns).
template <class Real>
void Transpose(const Real* from, Real* to, int rows, int columns);

}  // namespace airsim360

/// c (m rows of `columns` <= 16 numbers, `ldc` apart) = a (m x k by rows) times a panel (k x 16 by rows, on 64 bytes).
AIRSIM360_DECLARE_KERNEL(void MultiplyPanel(const float* a, const float* panel, float* c, int m, int k, int64_t ldc, int columns))
