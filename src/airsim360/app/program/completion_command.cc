// airsim360 completion: what bash, zsh and fish need to complete its command line.
#include <cstdio>
#include <memory>
#include <string>

#include "airsim360/app/flags/commands.h"
#include "airsim360/app/program/help.h"
#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

std::string Joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

std::vector<const CLI::App*> Inner(const CLI::App& command) {
  return command.get_subcommands([](const CLI::App*) { return true; });
}

std::vector<std::string> InnerNames(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::App* inner : Inner(command)) names.push_back(inner->get_name());
  return names;
}

struct Argument {
  std::vector<std::string> names;  // "--help", "-h"; of what has no flag: its name
  bool flag = true, value = false, files = false;
  std::vector<std::string> choices;
  std::string about;
};

// All that a command takes, but what is not for people.
std::vector<Argument> ArgumentsOf(const CLI::App& command) {
  std::vector<Argument> arguments;
  const std::string path = CommandPath(command);
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_group().empty()) continue;
    Argument argument;
    argument.flag = option->nonpositional();
    for (const std::string& name : option->get_lnames()) argument.names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) argument.names.push_back("-" + name);
    if (!argument.flag) argument.names = {option->get_name()};
    argument.value = option->get_type_size() != 0;
    argument.choices = ChoicesOf(path, argument.names.front());
    argument.files = TakesFiles(argument.names.front());
    argument.about = option->get_description();
    arguments.push_back(argument);
  }
  return arguments;
}

std::string BashScript(const CLI::App& program) {
  std::string commands, values, words;
  for (const CLI::App* command : CommandsOf(program)) {
    const std::string path = CommandPath(*command);
    if (!path.empty()) {
      const std::string above = CommandPath(*command->get_parent());
      commands += "      '" + above + "/" + command->get_name() + "') command='" + path + "' ;;\n";
    }
    std::string flags, rest = Joined(InnerNames(*command));
    bool files = false;
    for (const Argument& argument : ArgumentsOf(*command)) {
      if (!argument.flag) {
        rest += (rest.empty() ? "" : " ") + Joined(argument.choices);
        files |= argument.files;
        continue;
      }
      flags += (flags.empty() ? "" : " ") + Joined(argument.names);
      if (!argument.value) continue;
      for (const std::string& name : argument.names)
        values += "    '" + path + "/" + name + "') words='" + Joined(argument.choices) + "' files=" + (argument.files ? "1" : "") +
                  " value=1 ;;\n";
    }
    words += "      '" + path + "') flags='" + flags + "' words='" + rest + "' files=" + (files ? "1" : "") + " ;;\n";
  }
  return R"(# Completion of airsim360 in bash: made by 'airsim360 completion bash'.
_airsim360() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command= flags= words= files= value= i
  # --flag=value comes in three words.
  if [[ $word == = ]]; then word=
  elif [[ $before == = ]]; then before=${COMP_WORDS[COMP_CWORD-2]}; fi
  for ((i = 1; i < COMP_CWORD; ++i)); do
    case "$command/${COMP_WORDS[i]}" in
)" + commands +
         R"(    esac
  done
  case "$command/$before" in
)" + values +
         R"(  esac
  if [[ -z $value ]]; then
    case "$command" in
)" + words +
         R"(    esac
    if [[ $word == -* ]]; then words=$flags files=; fi
  fi
  COMPREPLY=($(compgen -W "$words" -- "$word"))
  if [[ -n $files ]]; then
    compopt -o filenames 2>/dev/null
    local IFS=$'\n'
    COMPREPLY+=($(compgen -f -- "$word"))
  fi
}
complete -F _airsim360 airsim360
)";
}

// Of a description in brackets and quotes.
std::string ZshText(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') out += '\\';
    out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return out;
}

std::string ZshAction(const Argument& argument) {
  std::string action;
  if (!argument.choices.empty()) action = "compadd -- " + Joined(argument.choices);
  if (argument.files) action += (action.empty() ? "" : "; ") + std::string("_files");
  return action.empty() ? " " : "{" + action + "}";
}

std::string ZshFunction(const CLI::App& command) {
  std::string name = "_airsim360";
  for (const char c : CommandPath(command).empty() ? "" : "_" + CommandPath(command)) name += c == ' ' ? '_' : c;
  std::string text = name + "() {\n  local line state\n  _arguments -S";
  for (const Argument& argument : ArgumentsOf(command)) {
    if (!argument.flag) {
      text += " \\\n    '*:" + ZshText(argument.names.front()) + ":" + ZshAction(argument) + "'";
      continue;
    }
    for (const std::string& flag : argument.names) {
      text += " \\\n    '" + flag + (argument.value && flag.starts_with("--") ? "=" : "") + "[" + ZshText(argument.about) + "]";
      if (argument.value) text += ":value:" + ZshAction(argument);
      text += "'";
    }
  }
  const auto inner = Inner(command);
  if (inner.empty()) return text + "\n}\n";
  text += " \\\n    '1: :->command' '*:: :->rest'\n  case $state in\n    command)\n      local -a commands=(\n";
  for (const CLI::App* one : inner) text += "        '" + one->get_name() + ":" + ZshText(one->get_description()) + "'\n";
  text += "      )\n      _describe command commands ;;\n    rest)\n      case $line[1] in\n";
  for (const CLI::App* one : inner) text += "        " + one->get_name() + ") " + name + "_" + one->get_name() + " ;;\n";
  return text + "      esac ;;\n  esac\n}\n";
}

std::string ZshScript(const CLI::App& program) {
  std::string text = "#compdef airsim360\n# Completion of airsim360 in zsh: made by 'airsim360 completion zsh'.\n";
  for (const CLI::App* command : CommandsOf(program)) text += ZshFunction(*command);
  return text +
         "if [ \"$funcstack[1]\" = \"_airsim360\" ]; then _airsim360 \"$@\"; else compdef _airsim360 "
         "airsim360; fi\n";
}

std::string FishText(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += (c == '\'' || c == '\\' ? "\\" : "") + std::string(1, c);
  return out + "'";
}

std::string FishScript(const CLI::App& program) {
  std::string known, lines;
  for (const CLI::App* command : CommandsOf(program)) {
    const std::string path = CommandPath(*command), at = "complete -c airsim360 -n \"__airsim360_at '" + path + "'\"";
    if (!path.empty()) known += " " + FishText(path);
    for (const CLI::App* inner : Inner(*command))
      lines += at + " -f -a " + inner->get_name() + " -d " + FishText(inner->get_description()) + "\n";
    for (const Argument& argument : ArgumentsOf(*command)) {
      lines += at;
      for (const std::string& name : argument.names) {
        if (argument.flag) lines += (name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1));
      }
      if (!argument.files) lines += " -f";
      if (argument.value && argument.flag) lines += " -r";
      if (!argument.choices.empty()) lines += " -a " + FishText(Joined(argument.choices));
      lines += " -d " + FishText(argument.about) + "\n";
    }
  }
  return R"(# Completion of airsim360 in fish: made by 'airsim360 completion fish'.
function __airsim360_at
    set -l path ''
    for word in (commandline -opc)[2..-1]
        set -l longer (string trim "$path $word")
        if contains -- "$longer")" +
         known + R"(
            set path $longer
        end
    end
    test "$path" = "$argv[1]"
end
complete -c airsim360 -f
)" + lines;
}

}  // namespace

void AddCompletionCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand("completion", "prints what a shell needs to complete commands, flags and names");
  const auto shell = std::make_shared<std::string>();
  command->add_option("shell", *shell, "bash, zsh or fish")->required();
  command->callback([&app, shell] {
    const std::vector<std::string> shells = {"bash", "zsh", "fish"};
    if (std::ranges::count(shells, *shell) == 0) throw InputError("completion: " + UnknownChoiceMessage("shell", *shell, shells));
    const std::string script = *shell == "bash" ? BashScript(app) : *shell == "zsh" ? ZshScript(app) : FishScript(app);
    std::fputs(script.c_str(), stdout);
  });
}

}  // namespace airsim360
