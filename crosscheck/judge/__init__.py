"""MuJoCo's answers to questions about robots, scenes and paths.

Beside a model `<name>.xml` lies `<name>.questions.parquet`, one row a configuration: the joint angles `q1`,
`q2`, ... in radians, and whether `frames`, `gaps` and `limits` are asked for besides contact. Nothing here
knows what answers are expected.
"""
