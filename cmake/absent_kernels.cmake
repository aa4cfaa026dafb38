# Names of the kernels of instruction sets that were not compiled, for the linker: code that traps. No program calls it,
# because base/kernel_isa.cc knows what is there.
# cmake -DNM=nm -DOBJECTS=a.o|b.o -DISA=avx2 -DOUT=absent.s -P absent_kernels.cmake
string(REPLACE "|" ";" objects "${OBJECTS}")
execute_process(COMMAND ${NM} -g --defined-only ${objects} OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
# Mangled names say how long each part is.
set(mangled_sse42 9isa_sse42)
set(mangled_avx2 8isa_avx2)
set(mangled_avx512 10isa_avx512)
string(REGEX MATCHALL "[^ \n]*${mangled_${ISA}}[^ \n]*" names "${symbols}")
set(text ".text\n")
foreach(isa sse42 avx2 avx512)
  if(NOT isa STREQUAL ISA)
    foreach(name ${names})
      string(REPLACE ${mangled_${ISA}} ${mangled_${isa}} other ${name})
      string(APPEND text ".globl ${other}\n${other}:\n")
    endforeach()
  endif()
endforeach()
file(WRITE ${OUT} "${text}  ud2\n.section .note.GNU-stack,\"\",@progbits\n")
