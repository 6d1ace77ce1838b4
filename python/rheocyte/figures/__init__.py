"""The figures of Mokbel et al. 2017, one module figureN.py each; `python -m rheocyte.figure` finds them by their names.

A module offers make(laboratory), which solves what the figure needs and returns the matplotlib figure and the rows of
its table. What could not be solved is drawn as a note; the laboratory remembers it.
"""
