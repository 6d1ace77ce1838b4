# The public names by groups: `rheocyte.__init__` loads them by this list, and the documentation shows them in this order.

# Solve a cell
from rheocyte.cases import Case as Case
from rheocyte.states import solve as solve
from rheocyte.states import Session as Session
from rheocyte.states import Result as Result
from rheocyte.in_time import evolve as evolve
from rheocyte.in_time import Evolution as Evolution

# Tables
from rheocyte.stiffness_tables import Table as Table
from rheocyte.stiffness_tables import table as table
from rheocyte.stiffness_tables import table_names as table_names
from rheocyte.stiffness_tables import viscosity as viscosity
from rheocyte.stiffness_tables import STATES as STATES

# Recordings
from rheocyte.recordings import extract as extract
from rheocyte.recordings import moduli as moduli
from rheocyte.recordings import time_course as time_course
from rheocyte.recordings import features as features
from rheocyte.recordings import synth as synth
from rheocyte.stiffness_tables import dclab_plugin as dclab_plugin

# Populations
from rheocyte.recordings import population as population
from rheocyte.populations import Population as Population
from rheocyte.recordings import plan as plan

# Small deformations
from rheocyte.analytical_model import analytic as analytic

# Mistakes
from rheocyte.errors import UserError as UserError
from rheocyte.errors import NoStateError as NoStateError

# Keys of a case
from rheocyte.cases import case_keys as case_keys

__version__: str
