/// Systematic damage: each value of a document that holds every key is broken in each way that its
/// schema knows, and the reader must refuse each with a JSON pointer to the place.
#include "io/json/scene_json.hpp"
#include "io/json/schema.hpp"

#include "tests/unit/io/scene_testing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <set>

namespace grainbench {
namespace {

using testing::HasSubstr;
using namespace testing_support;
using Pointer = Json::json_pointer;
using Visit = std::function<void(const Pointer&, const Json& value, const Json& schema)>;

/// Walks a document along its schema.
class Walk {
public:
    explicit Walk(Visit visit) : visit_(std::move(visit)) {
        const Json schema = Json::parse(io::scene_schema());
        definitions_ = schema.at("definitions");
    }

    void operator()(const Json& document) {
        go(Pointer(), document, {{"$ref", "#/definitions/Scene"}});
    }

    const Json& definitions() const { return definitions_; }

    /// "Species/radius" for each property of each definition that was met.
    std::set<std::string> met;

private:
    void go(const Pointer& at, const Json& value, const Json& schema) {
        if (schema.contains("allOf")) {
            go(at, value, schema.at("allOf").at(0));
        } else if (schema.contains("oneOf")) {
            for (const Json& choice : schema.at("oneOf")) {
                if (fits(value, definition(choice))) {
                    go(at, value, choice);
                }
            }
        } else if (schema.contains("$ref")) {
            const Json& target = definition(schema);
            visit_(at, value, target);
            for (const auto& entry : target.at("properties").items()) {
                if (value.contains(entry.key())) {
                    met.insert(name(schema) + "/" + entry.key());
                    go(at / entry.key(), value.at(entry.key()), entry.value());
                }
            }
        } else {
            visit_(at, value, schema);
            for (std::size_t i = 0; value.is_array() && i < value.size(); ++i) {
                go(at / i, value[i], schema.at("items"));
            }
        }
    }

    static std::string name(const Json& reference) {
        const auto text = reference.at("$ref").get<std::string>();
        return text.substr(text.rfind('/') + 1);
    }

    const Json& definition(const Json& reference) const { return definitions_.at(name(reference)); }

    static bool fits(const Json& value, const Json& target) {
        for (const auto& entry : target.at("properties").items()) {
            if (entry.value().contains("const") &&
                value.at(entry.key()) == entry.value().at("const")) {
                return true;
            }
        }
        return false;
    }

    Visit visit_;
    Json definitions_;
};

/// A broken document and what the message must name.
struct Mutant {
    std::string text;
    std::string pointer;
};

Mutant replaced(const Pointer& at, const Json& value) {
    Json document = every_key();
    document[at] = value;
    return {document.dump(), at.to_string()};
}

/// Values outside what the schema of a number allows.
std::vector<Json> outside(const Json& schema) {
    std::vector<Json> values;
    const auto low = schema.find("minimum");
    const auto above = schema.find("exclusiveMinimum");
    const auto high = schema.find("maximum");
    if (low != schema.end()) {
        values.push_back(low->get<double>() - 1.0);
    }
    if (above != schema.end()) {
        values.push_back(above->get<double>());
        values.push_back(above->get<double>() - 1.0);
    }
    if (high != schema.end()) {
        values.push_back(high->get<double>() + 1.0);
    }
    if (schema.at("type") == "integer") {
        values.insert(values.end(), {2.5, 1e300, 18446744073709551615u});
    }
    return values;
}

bool same_kind(const Json& a, const Json& b) {
    return a.type() == b.type() || (a.is_number() && b.is_number());
}

/// All ways to break the value at one place but those that break the syntax.
void break_value(const Pointer& at,
                 const Json& value,
                 const Json& schema,
                 std::vector<Mutant>& mutants) {
    for (const Json& other :
         {Json(), Json(true), Json(7), Json("seven"), Json::array(), Json::object()}) {
        if (!same_kind(value, other)) {
            mutants.push_back(replaced(at, other));
        }
    }
    if (value.is_number()) {
        for (const Json& number : outside(schema)) {
            mutants.push_back(replaced(at, number));
        }
    }
    if (value.is_string() && (schema.contains("enum") || schema.contains("const"))) {
        mutants.push_back(replaced(at, "no such name"));
    }
    if (!value.is_object()) {
        return;
    }
    mutants.push_back(replaced(at / "no_such_key", 1));
    mutants.push_back(replaced(at / "enabled", true));
    for (const Json& key : schema.value("required", Json::array())) {
        Json document = every_key();
        document[at].erase(key.get<std::string>());
        mutants.push_back({document.dump(), (at / key.get<std::string>()).to_string()});
    }
}

TEST(SceneMutation, DocumentHoldsEveryKeyThatASceneMayHave) {
    std::set<std::string> all;
    Walk walk([](const Pointer&, const Json&, const Json&) {});
    walk(every_key());
    for (const auto& definition : walk.definitions().items()) {
        if (definition.key().ends_with("Patch")) {
            continue;
        }
        for (const auto& property : definition.value().at("properties").items()) {
            all.insert(definition.key() + "/" + property.key());
        }
    }
    all.erase(
        "DisplacementTrigger/type");  // a scene has one trigger, and the other one has more keys
    EXPECT_EQ(walk.met, all);
}

TEST(SceneMutation, EveryBrokenValueIsRefusedWithItsPlace) {
    const auto folder = import_folder();
    ASSERT_FALSE(error_of(every_key().dump(), folder));
    std::vector<Mutant> mutants;
    Walk walk([&](const Pointer& at, const Json& value, const Json& schema) {
        break_value(at, value, schema, mutants);
    });
    walk(every_key());

    ASSERT_GT(mutants.size(), 1000u);
    for (const Mutant& mutant : mutants) {
        const auto error = error_of(mutant.text, folder);
        ASSERT_TRUE(error) << mutant.pointer << "\n" << mutant.text;
        ASSERT_EQ(error->kind(), ErrorKind::bad_input) << error->what();
        ASSERT_THAT(error->what(), HasSubstr(mutant.pointer)) << mutant.text;
    }
}

TEST(SceneMutation, EveryNumberThatIsNoneIsRefusedWithItsLine) {
    const auto folder = import_folder();
    std::vector<std::string> texts;
    Walk walk([&](const Pointer& at, const Json& value, const Json&) {
        if (!value.is_number()) {
            return;
        }
        for (const char* word : {"NaN", "-Infinity", "1e999"}) {
            std::string text = replaced(at, "@number@").text;
            texts.push_back(text.replace(text.find("\"@number@\""), 10, word));
        }
    });
    walk(every_key());

    ASSERT_GT(texts.size(), 300u);
    for (const std::string& text : texts) {
        const auto error = error_of(text, folder);
        ASSERT_TRUE(error) << text;
        ASSERT_THAT(error->diagnosis().where, HasSubstr("line 1, column ")) << text;
    }
}

TEST(SceneMutation, EveryMisspeltKeyIsTracedToTheKeyMeant) {
    const auto folder = import_folder();
    std::size_t misspelt = 0;
    Walk walk([&](const Pointer& at, const Json& value, const Json&) {
        if (!value.is_object()) {
            return;
        }
        for (const auto& entry : value.items()) {
            if (entry.key().size() < 4) {
                continue;  // a slip in a short name may be nearer to another
            }
            Json document = every_key();
            const std::string slip = entry.key() + "s";
            document[at][slip] = entry.value();
            const auto error = error_of(document.dump(), folder);
            ASSERT_TRUE(error) << (at / slip).to_string();
            EXPECT_EQ(error->diagnosis().where, "test.json: " + (at / slip).to_string());
            EXPECT_THAT(error->diagnosis().likely_cause, HasSubstr("'" + entry.key() + "'"));
            ++misspelt;
        }
    });
    walk(every_key());
    EXPECT_GT(misspelt, 150u);
}

TEST(SceneMutation, DamagedBytesNeverDoMoreThanThrowAnError) {
    const auto folder = import_folder();
    const std::string text = every_key().dump(1);
    const std::string bytes = "{}[]\",:0-e.\\\n\xff\x01nt/";
    std::mt19937 random(1);  // its numbers are fixed by the standard, so a failure can be repeated
    std::size_t refused = 0;
    for (int i = 0; i < 3000; ++i) {
        std::string damaged = text;
        for (std::size_t k = 0; k <= random() % 3; ++k) {
            damaged[random() % damaged.size()] = bytes[random() % bytes.size()];
        }
        if (i % 10 == 0) {
            damaged.resize(random() % damaged.size());
        }
        refused += error_of(damaged, folder) ? 1 : 0;
    }
    EXPECT_GT(refused, 1500u);
}

}  // namespace
}  // namespace grainbench
