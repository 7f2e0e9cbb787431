#include <cstdint>
#include <memory>
#include <string>

#include <fmt/core.h>

#include "tools/bench/commands.hpp"
#include "tools/bench/plan/scene_families.hpp"
#include "tools/cli/exit.hpp"

namespace swallowtail::bench {

void add_scene(CLI::App& app, cli::Exit& exit) {
  struct Wish {
    std::string family;
    std::uint64_t seed = 1;
  };
  CLI::App* command = app.add_subcommand("scene", "Print a scene of a random family as a scenario file");
  const auto wish = std::make_shared<Wish>();
  command->add_option("FAMILY", wish->family, "hills_and_balls or mixed_shapes")
      ->required()
      ->check(CLI::IsMember({"hills_and_balls", "mixed_shapes"}));
  command->add_option("--seed", wish->seed, "Seed of the scene")->capture_default_str();
  command->footer(
      std::string("Examples:\n  swallowtail bench scene hills_and_balls --seed 7 > scene.yaml\n") +
      "  swallowtail bench plan scene.yaml\n" + cli::kExitCodesHelp);
  command->callback([wish, &exit] {
    fmt::print("{}", wish->family == "mixed_shapes" ? mixed_shapes_yaml(wish->seed)
                                                    : hills_and_balls_yaml(wish->seed));
    exit = cli::Exit::kDone;
  });
}

}  // namespace swallowtail::bench
