// airsim360 <command>.
#include "airsim360/app/program/program.h"

int main(int argc, char** argv) { return airsim360::Main(argc, argv, airsim360::AllCommands()); }
