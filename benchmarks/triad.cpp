// Memory bandwidth of this machine: a[i] = b[i] + s c[i] over arrays far larger than any cache.
// c++ -O3 -march=native -fopenmp triad.cpp -o triad; OMP_NUM_THREADS=2 ./triad
// Prints GB/s, the best of several passes, counting 16 bytes read and 8 written per element.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>

int main(int argc, char **argv)
{
  const long n = (argc > 1 ? std::atol(argv[1]) : 400) * 1000000 / 24;    // megabytes in all
  using Array = std::unique_ptr<double[]>;    // not set to zero by one thread: see first loop
  const Array a(new double[n]), b(new double[n]), c(new double[n]);
  double *const pa = a.get(), *const pb = b.get(), *const pc = c.get();
#pragma omp parallel for schedule(static)
  for (long i = 0; i < n; i++) {
    pa[i] = 0.0;
    pb[i] = 1.0;
    pc[i] = 0.5;
  }
  double best = 1.0e30;
  for (int pass = 0; pass < 12; pass++) {
    const auto start = std::chrono::steady_clock::now();
    const double s = 1.0 + pass;
#pragma omp parallel for schedule(static)
    for (long i = 0; i < n; i++) pa[i] = pb[i] + s * pc[i];
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    best = std::min(best, took.count());
  }
  if (pa[n / 2] != 1.0 + 12.0 * 0.5) return 1;
  std::printf("%.2f\n", 24.0e-9 * n / best);
}
