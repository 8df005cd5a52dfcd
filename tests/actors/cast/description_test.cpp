#include "castor/actors/cast/description.hpp"

#include "castor/actors/cast/json.hpp"
#include "castor/tests/actors/cast/support.hpp"

#include <gtest/gtest.h>

#include <string>

namespace castor {

namespace {

using cast::test::parse;
using cast::test::system_with;

TEST(Description, FindsComponentsByName) {
  auto result = parse(system_with("CPP MG a A\nCOMPONENT CPP x X"));
  ASSERT_TRUE(result.ok());
  const auto& architecture = *result.architecture;
  EXPECT_EQ(architecture.component("a")->class_name, "A");
  EXPECT_EQ(architecture.component("x")->class_name, "X");
  EXPECT_EQ(architecture.component("sa_wm")->kind, ComponentKind::working_memory);
  EXPECT_EQ(architecture.component("sa_tm")->kind, ComponentKind::task_manager);
  EXPECT_EQ(architecture.component("b"), nullptr);
  EXPECT_EQ(architecture.subarchitecture("sa")->component("x"), nullptr);
  EXPECT_EQ(architecture.subarchitecture("sb"), nullptr);
}

TEST(Description, FindsOptionsWithAndWithoutDashes) {
  ComponentDescription component;
  component.options = {{"--min-area", "1", {}}, {"-v", "2", {}}};
  EXPECT_EQ(component.option("min-area")->value, "1");
  EXPECT_EQ(component.option("--min-area")->value, "1");
  EXPECT_EQ(component.option("v")->value, "2");
  EXPECT_EQ(component.option("x"), nullptr);
}

TEST(Description, NamesOptionsWithoutLeadingDashes) {
  EXPECT_EQ((OptionSetting{"--min-area", "", {}}.name()), "min-area");
  EXPECT_EQ((OptionSetting{"-v", "", {}}.name()), "v");
  EXPECT_EQ((OptionSetting{"-", "", {}}.name()), "");
}

TEST(Description, NamesKindsAndLanguages) {
  EXPECT_EQ(to_string(ComponentKind::standalone), "stand-alone");
  EXPECT_EQ(to_string(ComponentKind::unmanaged), "unmanaged");
  EXPECT_EQ(to_string(Language::cpp), "C++");
  EXPECT_EQ(to_string(Language::python), "Python");
}

TEST(Json, HoldsTheWholeDescription) {
  auto result = parse("HOSTNAME Main robot\nHOST [Main]\nACCESS s WRITES *\nSUBARCHITECTURE s\n"
                      "CPP WM W --log\nCPP TM T\nCPP MG a A --k \"v w\"\nCOMPONENT CPP x X\n"
                      "SUPERVISE s one_for_all\nFAILOVER a TO other\n");
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(to_json(*result.architecture), R"({
  "file": "main.cast",
  "config_dir": ".",
  "host_names": {
    "Main": "robot"
  },
  "subarchitectures": [
    {
      "name": "s",
      "host": "robot",
      "working_memory": {
        "name": "s_wm",
        "kind": "working memory",
        "class": "W",
        "language": "C++",
        "host": "robot",
        "number": 0,
        "options": [
          {
            "key": "--log",
            "value": "true"
          }
        ],
        "where": {
          "file": "main.cast",
          "line": 5
        }
      },
      "task_manager": {
        "name": "s_tm",
        "kind": "task manager",
        "class": "T",
        "language": "C++",
        "host": "robot",
        "number": 1,
        "options": [],
        "where": {
          "file": "main.cast",
          "line": 6
        }
      },
      "components": [
        {
          "name": "a",
          "kind": "managed",
          "class": "A",
          "language": "C++",
          "host": "robot",
          "number": 2,
          "options": [
            {
              "key": "--k",
              "value": "v w"
            }
          ],
          "where": {
            "file": "main.cast",
            "line": 7
          }
        }
      ],
      "where": {
        "file": "main.cast",
        "line": 4
      }
    }
  ],
  "standalone": [
    {
      "name": "x",
      "kind": "stand-alone",
      "class": "X",
      "language": "C++",
      "host": "robot",
      "number": 3,
      "options": [],
      "where": {
        "file": "main.cast",
        "line": 8
      }
    }
  ],
  "access_rules": [
    {
      "writer": "s",
      "owner": "*",
      "where": {
        "file": "main.cast",
        "line": 3
      }
    }
  ],
  "read_rules": [],
  "supervision": [
    {
      "who": "s",
      "strategy": "one_for_all",
      "restarts": 3,
      "period_ms": 10000,
      "first_delay_ms": 100,
      "longest_delay_ms": 5000,
      "where": {
        "file": "main.cast",
        "line": 9
      }
    }
  ],
  "failover": [
    {
      "who": "a",
      "hosts": [
        "other"
      ],
      "where": {
        "file": "main.cast",
        "line": 10
      }
    }
  ]
})");
}

TEST(Json, HoldsTheDiagnosticsOfAParse) {
  auto result = parse("INCLUDE b.cast", {{{"b.cast", "#EXPAND x\nnonsense"}}, {}});
  EXPECT_EQ(cast::to_json(result), R"({
  "ok": false,
  "diagnostics": [
    {
      "severity": "error",
      "where": {
        "file": "b.cast",
        "line": 2,
        "included_from": [
          {
            "file": "main.cast",
            "line": 1
          }
        ]
      },
      "line": "nonsense",
      "expanded": "",
      "message": "'nonsense' is not a keyword",
      "remedy": "write SUBARCHITECTURE, HOST, COMPONENT, ACCESS, SUPERVISE, FAILOVER or INCLUDE, or # before a comment"
    }
  ],
  "expansions": [
    "#EXPAND x"
  ],
  "architecture": null
})");
}

TEST(Json, SurvivesBytesThatAreNoUtf8) {
  auto result = parse(system_with("CPP MG a A --x \xff\xfe"));
  ASSERT_TRUE(result.ok());
  EXPECT_NE(to_json(*result.architecture).find("\xef\xbf\xbd"), std::string::npos);
}

} // namespace

} // namespace castor
