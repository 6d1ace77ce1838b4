"""Pictures of what rheocyte computed. Needs numpy and matplotlib only."""
