// airsim360_pictures collect: the program that `make demo` builds first, of fewer sources.
#include "airsim360/app/program/program.h"

int main(int argc, char** argv) { return airsim360::Main(argc, argv, {{airsim360::AddCollectCommand}, {}}); }
