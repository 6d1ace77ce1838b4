/* The header alone, as C99. */
#include "rheocyte_cell.h"

uint32_t rheocyte_cell_interface_of_header(void);
uint32_t rheocyte_cell_interface_of_header(void) { return RHEOCYTE_CELL_ABI; }
