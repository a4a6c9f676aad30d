// `slideway compile`: a header with a law or mechanism of one's own becomes modules that scenes know by name, the plan of a linkage one that its scenes find.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "host/backend/own_modules.hpp"
#include "host/base/error.hpp"

namespace slideway {

/// The compiler refused the header; what() is the line to print behind its words.
class CompileError : public SceneError {
public:
    CompileError(std::string_view line, std::string compiler_words) : SceneError(line), words(std::move(compiler_words)) {}
    std::string words;
};

struct CompileRequest {
    std::string header;      // its file, or what messages call it where its text is given
    std::string text;
    std::string folder;      // where the modules go; "": the user's own, which every scene finds
    std::vector<Isa> isas;   // that this machine runs; none: all of this program
    int threads = 1;         // how many compilers may run at once
    std::string (*objection)(ModuleKind, KernelModule const&);  // why a module cannot be named in scenes; "" of one that can
};

/// What came of it.
struct CompiledModule {
    ModuleKind kind;
    std::string name;    // contact.law, mechanism.kind, or linkage_module_name()
    std::string source;  // hash of the header and of what it includes beyond what every module has
    std::vector<std::string> files;
    bool was_there = false;  // of this source already: nothing was compiled
};

/// A law where the header says `#define SLIDEWAY_LAW Type`, a mechanism where it says `#define SLIDEWAY_MECHANISM Type`, or both; a linkage where it says
/// `#define SLIDEWAY_LINKAGE Type`, as linkage_header() does.  A module that was
/// there is replaced once the new one is whole.
/// @throws SceneError for a header that offers nothing, or what cannot be used; CompileError; DeviceError without headers of the kernels or a compiler; FileError
std::vector<CompiledModule> compile_modules(CompileRequest const& request);

}  // namespace slideway
