// SPDX-License-Identifier: GPL-3.0-or-later
// Eigenvalues and eigenvectors of symmetric 3 x 3 matrices, with the same bits on every machine.
#pragma once

// Eigenvalues, ascending, each with its unit eigenvector vectors[k], whose sign has no meaning.
void symmetric_eigen(const double matrix[3][3], double values[3], double vectors[3][3]);
