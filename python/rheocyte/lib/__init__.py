"""The compiled module `native`, where it is installed; the pictures need none of it."""
