// expect: the law is missing its stiffness
int main() {
  return undeclared;
}
