"""Ninepoint's windows and commands: the only package that knows Qt."""
