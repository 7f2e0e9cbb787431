// The schema is the authority and the reader is code: here they are held against each other, over the corpus
// and over every single change of a file that names every key.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "planner/scenario/read.hpp"
#include "planner/scenario/schema.hpp"
#include "tests/unit/planner/scenario/json_schema.hpp"

namespace swallowtail::planner {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

const fs::path kCorpus = fs::path(SWALLOWTAIL_SOURCE_DIR) / "tests/data/scenarios";

std::string text_of(const fs::path& file) {
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

bool schema_can_say(ScenarioError::Kind kind) {
  return kind == ScenarioError::Kind::kType || kind == ScenarioError::Kind::kUnknownKey ||
         kind == ScenarioError::Kind::kMissingKey || kind == ScenarioError::Kind::kNotFinite ||
         kind == ScenarioError::Kind::kRange;
}

/// Reader and schema judge the text alike as far as a schema can.
void expect_agreement(const std::string& yaml, const std::string& what) {
  const json schema = json::parse(scenario_schema());
  std::string why;
  const bool conforms = test::conforms(schema, test::yaml_to_json(yaml), why);
  const ScenarioResult result = parse_scenario(yaml, "text.yaml", (kCorpus / "valid").string());
  const bool refused =
      !result.ok() && std::ranges::any_of(result.errors().errors,
                                          [](const ScenarioError& e) { return schema_can_say(e.kind); });
  EXPECT_EQ(conforms, !refused) << what << "\nschema: " << (conforms ? "conforms" : why)
                                << "\nreader: " << (result.ok() ? "no error" : result.errors().text());
}

TEST(ScenarioSchema, AgreesWithTheReaderOverTheCorpus) {
  for (const char* folder : {"valid", "invalid"}) {
    for (const auto& entry : fs::directory_iterator(kCorpus / folder)) {
      const std::string text = text_of(entry.path());
      const ScenarioResult result = parse_scenario(text, entry.path().string(), (kCorpus / folder).string());
      if (!result.ok() && result.errors().errors.front().kind == ScenarioError::Kind::kSyntax) continue;
      expect_agreement(text, entry.path().string());
    }
  }
}

/// Every pointer into a document.
void collect(const json& value, const json::json_pointer& at, std::vector<json::json_pointer>& out) {
  out.push_back(at);
  if (value.is_object()) {
    for (const auto& [key, inner] : value.items()) collect(inner, at / key, out);
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i) collect(value[i], at / i, out);
  }
}

TEST(ScenarioSchema, AgreesWithTheReaderWhateverSingleValueIsChanged) {
  const std::vector<json> replacements = {0,
                                          -1,
                                          0.5,
                                          1,
                                          63,
                                          1e3,
                                          -1e4,
                                          2e6,
                                          1e12,
                                          "word",
                                          "",
                                          true,
                                          nullptr,
                                          json::array(),
                                          json::object(),
                                          json::array({1, 2}),
                                          json::array({1, 2, 3})};
  for (const char* file : {"full.yaml", "flat.yaml", "raster.yaml", "smallest.yaml"}) {
    const json document = test::yaml_to_json(text_of(kCorpus / "valid" / file));
    std::vector<json::json_pointer> places;
    collect(document, json::json_pointer(), places);
    for (const auto& place : places) {
      if (place.empty()) continue;
      json removed = document;
      json& parent = removed[place.parent_pointer()];
      if (parent.is_object())
        parent.erase(place.back());
      else
        parent.erase(static_cast<std::size_t>(std::stoul(place.back())));
      expect_agreement(test::json_to_yaml(removed), std::string(file) + " without " + place.to_string());
      for (const json& replacement : replacements) {
        json changed = document;
        changed[place] = replacement;
        expect_agreement(test::json_to_yaml(changed),
                         std::string(file) + " with " + place.to_string() + " = " + replacement.dump());
      }
      if (document[place].is_object()) {
        json added = document;
        added[place]["no_such_key"] = 1;
        expect_agreement(test::json_to_yaml(added),
                         std::string(file) + " with a new key in " + place.to_string());
      }
    }
  }
}

/// Every property that the schema names is in a valid file of the corpus, so that the test above reaches it.
void properties_of(const json& schema, std::vector<std::string>& out) {
  if (schema.is_object() && schema.contains("properties") && schema["properties"].is_object()) {
    for (const auto& [key, inner] : schema["properties"].items()) out.push_back(key);
  }
  if (schema.is_structured()) {
    for (const auto& inner : schema) properties_of(inner, out);
  }
}

TEST(ScenarioSchema, EveryPropertyStandsInTheCorpus) {
  std::string all;
  for (const auto& entry : fs::directory_iterator(kCorpus / "valid")) all += text_of(entry.path());
  std::vector<std::string> keys;
  properties_of(json::parse(scenario_schema()), keys);
  EXPECT_GT(keys.size(), 80u);
  for (const std::string& key : keys) EXPECT_NE(all.find(key + ":"), std::string::npos) << key;
}

}  // namespace
}  // namespace swallowtail::planner
