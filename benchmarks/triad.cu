// Memory bandwidth of the first GPU: a[i] = b[i] + s c[i], arrays of 1 GB each
// nvcc -O3 -arch=native triad.cu -o triad; prints GB/s, the best of several passes, counting
// 16 bytes read and 8 written per element.

#include <algorithm>
#include <cstdio>

__global__ void fill(double *a, double value, long n)
{
  for (long i = blockIdx.x * long(blockDim.x) + threadIdx.x; i < n;
       i += long(gridDim.x) * blockDim.x)
    a[i] = value;
}

__global__ void triad(double2 *a, const double2 *b, const double2 *c, double s, long n)
{
  const long i = blockIdx.x * long(blockDim.x) + threadIdx.x;
  if (i < n) a[i] = make_double2(b[i].x + s * c[i].x, b[i].y + s * c[i].y);
}

int main()
{
  const long n = 1L << 27;
  double *a, *b, *c;
  cudaMalloc(&a, n * sizeof(double));
  cudaMalloc(&b, n * sizeof(double));
  cudaMalloc(&c, n * sizeof(double));
  if (const cudaError_t error = cudaGetLastError()) {
    std::fprintf(stderr, "triad: %s\n", cudaGetErrorString(error));
    return 1;
  }
  fill<<<1024, 256>>>(b, 1.0, n);
  fill<<<1024, 256>>>(c, 0.5, n);
  cudaEvent_t start, stop;
  cudaEventCreate(&start);
  cudaEventCreate(&stop);
  float best = 1.0e30f;
  for (int pass = 0; pass < 12; pass++) {
    cudaEventRecord(start);
    triad<<<n / 2 / 256, 256>>>((double2 *) a, (const double2 *) b, (const double2 *) c, 1.0 + pass,
                                n / 2);
    cudaEventRecord(stop);
    cudaEventSynchronize(stop);
    float milliseconds;
    cudaEventElapsedTime(&milliseconds, start, stop);
    best = std::min(best, milliseconds);
  }
  double last = 0.0;
  cudaMemcpy(&last, a + n / 2, sizeof(double), cudaMemcpyDeviceToHost);
  if (const cudaError_t error = cudaGetLastError()) {
    std::fprintf(stderr, "triad: %s\n", cudaGetErrorString(error));
    return 1;
  }
  if (last != 1.0 + 12.0 * 0.5) return 1;
  std::printf("%.1f\n", 24.0e-6 * n / best);
}
