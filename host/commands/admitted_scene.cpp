// Apart from what else is printed, for this alone has members evaluated.
#include "host/commands/text.hpp"
#include "host/study/admission.hpp"

namespace slideway::cli {

Scene admitted_scene(SceneArguments const& arguments, bool any_start) {
    Scene scene = load_scene(arguments);
    auto const starts = admit(scene, any_start);
    for (std::string const& warning : scene.warnings) tell("warning: {}\n", warning);
    if (starts) tell("warning: {}\n", *starts);
    return scene;
}

}  // namespace slideway::cli
