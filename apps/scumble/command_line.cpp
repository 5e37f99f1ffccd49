#include "command_line.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <limits>

#include "json_option.h"
#include "report.h"

namespace scumble::app {

namespace {

bool isOption(const std::string& word) {
  return word.size() > 1 && word[0] == '-';
}

// The command that was given, or the program.
const CLI::App& commandOf(const CLI::App& program) {
  const std::vector<CLI::App*> given = program.get_subcommands();
  return given.empty() ? program : commandOf(*given.front());
}

// "scumble farm slurm".
std::string callOf(const CLI::App& command) {
  return command.get_parent() ? callOf(*command.get_parent()) + " " + command.get_name() : "scumble";
}

std::string helpOf(const CLI::App& command) {
  return "`" + callOf(command) + " --help` shows what there is";
}

// The option that the parser's message is about, or null.
const CLI::Option* optionOf(const CLI::App& command, const std::string& message) {
  const auto names = [&](const std::string& name, size_t at) {
    const size_t end = at + name.size();
    return message.compare(at, name.size(), name) == 0 &&
           (end == message.size() || message[end] == ' ' || message[end] == ':');
  };
  for (const CLI::Option* option : command.get_options()) {
    // It stands first, sometimes without its dashes, or after a colon.
    const std::string name = option->get_name();
    const size_t after = message.find(": ");
    if (names(name, 0) || (after != std::string::npos && names(name, after + 2))) return option;
    for (const std::string& bare : option->get_lnames())
      if (names(bare, 0)) return option;
  }
  return nullptr;
}

// What values of an option are, in the parser's word for their type.
std::string kindOf(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  if (type.starts_with("UINT"))
    return "whole number from 0 to " + std::to_string(std::numeric_limits<uint32_t>::max());
  if (type.starts_with("INT")) return "whole number";
  return type.starts_with("FLOAT") ? "number" : "value that it may have";
}

Error unexpected(const CLI::App& command, const std::string& word) {
  if (isOption(word)) {
    const std::string name = word.substr(0, word.find('='));
    std::vector<std::string> known;
    for (const CLI::Option* option : command.get_options())
      for (const std::string& each : option->get_lnames()) known.push_back("--" + each);
    return usage("there is no option '" + name + "'", suggestion(name, known, helpOf(command)));
  }
  if (command.get_parent() && command.get_subcommands(nullptr).empty())
    return usage("'" + word + "' is one argument too many", helpOf(command));
  std::vector<std::string> known;
  for (const CLI::App* each : command.get_subcommands(nullptr)) known.push_back(each->get_name());
  std::error_code ignored;
  const bool isScene =
      word.ends_with(".glb") || word.ends_with(".gltf") || std::filesystem::is_regular_file(word, ignored);
  const std::string before = command.get_parent() ? command.get_name() + " " : "";
  return usage("there is no command '" + before + word + "'",
               isScene && before.empty() ? "did you mean `scumble render " + word + "`?"
                                         : suggestion(word, known, helpOf(command)));
}

}  // namespace

std::vector<std::string> wordsOf(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  for (size_t i = 0; i < words.size(); ++i)
    if (words[i] == "--json" && (i + 1 == words.size() || !JsonOption::isFile(words[i + 1])))
      words[i] += std::string("=") + JsonOption::kPrinted;
  return words;
}

void refuseSlips(CLI::App& program) {
  const CLI::Validator given([](const std::string& value) { return value.empty() ? "it is empty" : ""; }, "");
  for (CLI::App* command : program.get_subcommands(nullptr)) {
    refuseSlips(*command);
    for (CLI::Option* option : command->get_options()) {
      if (option->get_expected_max() == 0) option->disable_flag_override();
      if (option->get_expected_max() > 0 && !option->get_positional()) option->check(given);
    }
  }
}

Error wrongWords(const CLI::App& program, const CLI::ParseError& error) {
  const CLI::App& command = commandOf(program);
  const std::string message = error.what();
  if (dynamic_cast<const CLI::ExtrasError*>(&error)) {
    const std::vector<std::string> words = program.remaining(true);
    // Before a command there is no word; an option before it is the program's.
    const auto word = std::find_if_not(words.begin(), words.end(), isOption);
    if (!words.empty())
      return unexpected(command, &command == &program && word != words.end() ? *word : words.front());
  }
  const CLI::Option* option = optionOf(command, message);
  if (!option) return usage(message, helpOf(command));
  const std::string name = option->get_name();
  const std::vector<std::string>& values = option->results();
  if (dynamic_cast<const CLI::RequiredError*>(&error))
    return usage(name + " is missing", "write `" + callOf(command) + " " + name + "`");
  if (dynamic_cast<const CLI::ConversionError*>(&error) && !values.empty())
    return usage("'" + values.back() + "' is no " + kindOf(*option), "give " + name + " another");
  if (option->get_expected_max() == 0)
    return usage(name + " takes no value", "leave '=' and what follows away");
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error))
    return values.size() > 1
               ? usage(name + " is given " + std::to_string(values.size()) + " times", "give it once")
               : usage(name + " needs a value", helpOf(command));
  if (dynamic_cast<const CLI::ValidationError*>(&error) &&
      std::find(values.begin(), values.end(), "") != values.end())
    return usage("the value of " + name + " is empty", "give one, or leave the option out");
  return usage(message, helpOf(command));
}

}  // namespace scumble::app
