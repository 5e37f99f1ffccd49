# Writes OUT, rows of a C++ table: names and texts of FILES (looks).
set(rows "")
foreach(file ${FILES})
  get_filename_component(name ${file} NAME_WE)
  file(READ ${file} text)
  string(APPEND rows "{\"${name}\", R\"LOOK(${text})LOOK\"},\n")
endforeach()
file(WRITE ${OUT} "${rows}")
