// A contact law: compiled once per instruction set with its own flags and names (CMakeLists.txt here), and knows no other law.
#include "host/backend/cpu_laws.hpp"
#include "kernels/laws/law_table.hpp"
#include SLIDEWAY_HEADER

namespace slideway::inline SLIDEWAY_ISA {

extern constinit LawTable<IsaReal> const SLIDEWAY_TABLE = LawTable<IsaReal>::of<SLIDEWAY_LAW>();

}  // namespace slideway::inline SLIDEWAY_ISA
