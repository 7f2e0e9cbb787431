#include <memory>
#include <string>

#include "planner/scenario/schema.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/output.hpp"

namespace swallowtail::cli {

void add_schema(CLI::App& app, Exit& exit) {
  CLI::App* command = app.add_subcommand("schema", "Print the JSON Schema of scenario files");
  const auto common = std::make_shared<Common>();
  add_common(*command, *common, "  swallowtail schema -o scenario.schema.json");
  command->callback([common, &exit] {
    if (const Status status = check_output(*common, {".json"}); !status.ok()) {
      exit = fail(status.error());
      return;
    }
    const std::string text(planner::scenario_schema());
    exit = deliver(*common, {nlohmann::ordered_json::parse(text), text, {{".json", [text] { return text; }}}},
                   Exit::kDone);
  });
}

}  // namespace swallowtail::cli
