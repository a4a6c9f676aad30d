// Whether nvcc works with this host compiler, for C++20 and the cards in question.
__global__ void nothing() {}
int main() { nothing<<<1, 1>>>(); }
