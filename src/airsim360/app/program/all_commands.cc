#include "airsim360/app/flags/commands.h"
#include "airsim360/app/program/program.h"

namespace airsim360 {

// Completion and manual pages are made of all that is there.
CommandSet AllCommands() {
  return {.commands = {AddWorldsCommand,  AddWorldCommand,   AddRenderCommand,       AddCollectCommand,  AddPlanCommand,  AddVerifyCommand,
                       AddVideoCommand,   AddDatasetCommand, AddStitchCommand,       AddEvalCommand,     AddMpdeCommand,  AddFlyCommand,
                       AddServeCommand,   AddAgentCommand,   AddVlnCommand,          AddLanguageCommand, AddViewCommand,  AddPeopleCommand,
                       AddTrafficCommand, AddDroneCommand,   AddEnvironmentsCommand, AddBenchCommand,    AddDoctorCommand},
          .own = {AddLearnCommand, AddCompletionCommand, AddManCommand}};
}

}  // namespace airsim360
