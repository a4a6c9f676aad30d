// A unit as no kernel may be: its inline function is in no instruction set's namespace and survives as a weak symbol.
// The test IsaPurity.FindsSharedFunction checks that isa_purity.sh reports it.
namespace slideway {

namespace avx2 {
int own_function();
int own_function() { return 1; }
}  // namespace avx2

__attribute__((noinline)) inline int shared_function(int x) { return 3 * x; }
int use_of_shared_function(int x);
int use_of_shared_function(int x) { return shared_function(x); }

}  // namespace slideway
